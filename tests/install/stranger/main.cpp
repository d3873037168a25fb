#include <iostream>

#include <quasimc/quasimc.h>

int main() {
    std::cout << quasimc::version() << '\n';
}

#include <stdio.h>

#include <quasimc/capi.h>

int main(void) {
    puts(quasimc_version());
    return quasimc_abi_version() == QUASIMC_ABI_VERSION ? 0 : 1;
}

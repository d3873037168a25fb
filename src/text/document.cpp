#include "text/document.h"

#include <algorithm>

namespace quasimc {

const Node* Node::find(std::string_view key) const {
    const Table* table = as<Table>();
    if (table == nullptr) {
        return nullptr;
    }
    const auto found = std::find_if(
        table->begin(), table->end(), [key](const Member& member) { return member.key == key; });
    return found == table->end() ? nullptr : &found->node;
}

std::string_view Node::type_name() const {
    switch (value.index()) {
        case 0:
            return "true or false";
        case 1:
            return "an integer";
        case 2:
            return "a number";
        case 3:
            return "a text";
        case 4:
            return "a list";
        case 5:
            return "a table";
        default:
            return as<Other>()->type;
    }
}

}  // namespace quasimc

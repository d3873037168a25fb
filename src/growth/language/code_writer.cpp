#include "growth/language/code_writer.h"

namespace quasimc {

void ModelNames::begin_system() {
    system_.clear();
    arrays_.clear();
    production_.clear();
    in_production_ = false;
}

void ModelNames::add_globals() {
    global_.insert_or_assign("Q", VariableName{true, kStepVariable});
    global_.insert_or_assign("Z", VariableName{true, kLengthVariable});
}

const VariableName* ModelNames::find(std::string_view name) const {
    for (const Table* table : {&production_, &system_, &global_}) {
        if (table == &production_ && !in_production_) {
            continue;
        }
        const auto found = table->find(name);
        if (found != table->end()) {
            return &found->second;
        }
    }
    return nullptr;
}

VariableName ModelNames::add(std::string_view name, LSystem& system) {
    const VariableName added{false, static_cast<std::int32_t>(system.variables.size())};
    system.variables.push_back(0);
    (in_production_ ? production_ : system_).insert_or_assign(std::string(name), added);
    return added;
}

VariableName ModelNames::add_parameter(std::string_view name, LSystem& system) {
    const auto found = production_.find(name);
    return found != production_.end() ? found->second : add(name, system);
}

const std::int32_t* ModelNames::find_array(std::string_view name) const {
    const auto found = arrays_.find(name);
    return found == arrays_.end() ? nullptr : &found->second;
}

CodeIndex CodeWriter::add(Op op, std::int32_t a, std::size_t n) {
    program_.code.push_back({op, static_cast<std::uint8_t>(n), a});
    program_.lines.push_back(line_);
    return here() - 1;
}

void CodeWriter::add_constant(double value) {
    add(Op::constant, static_cast<std::int32_t>(program_.constants.size()));
    program_.constants.push_back(value);
}

std::int32_t CodeWriter::text(std::string_view text) {
    program_.strings.emplace_back(text);
    return static_cast<std::int32_t>(program_.strings.size()) - 1;
}

}  // namespace quasimc

#pragma once

// Errors in the input, their exception, and warnings; input files, and sinks of text.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace quasimc {

/// One error in the input. Printed as "where: problem (why); suggestion".
struct Fault {
    std::string where;       ///< file:line, key or organ
    std::string problem;     ///< the error
    std::string why;         ///< the rule that it breaks; may be empty
    std::string suggestion;  ///< the remedy; may be empty

    [[nodiscard]] std::string text() const;
};

/// Input that is allowed but probably not meant.
struct Warning {
    std::string where, text;
};

/// Thrown for errors in the input; carries all faults, at least one.
class InputError : public std::runtime_error {
  public:
    explicit InputError(std::vector<Fault> faults);
    [[nodiscard]] const std::vector<Fault>& faults() const { return faults_; }

  private:
    std::vector<Fault> faults_;
};

/// Collects faults, so that all of a file are reported at once.
class Faults {
  public:
    void add(Fault fault) { faults_.push_back(std::move(fault)); }
    void add(const InputError& error);
    void add(const Faults& others);
    [[nodiscard]] bool empty() const { return faults_.empty(); }
    [[nodiscard]] std::size_t size() const { return faults_.size(); }
    /// All faults, in the order in which they were added.
    [[nodiscard]] const std::vector<Fault>& all() const { return faults_; }
    /// Throws an InputError if there are any.
    void throw_if_any() const;

  private:
    std::vector<Fault> faults_;
};

/// A file that a run was made from.
struct InputFile {
    std::string path;  ///< the given path
    std::string absolute_path;
    std::string sha256;  ///< SHA-256 of its bytes, 64 hexadecimal digits
    std::uint64_t bytes = 0;
    bool is_run_file = false;
};

/// Takes text in pieces.
using TextSink = std::function<void(std::string_view)>;

}  // namespace quasimc

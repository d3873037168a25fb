#pragma once

// What is wrong with an input, the exception that says so, and warnings; files that are read, and
// where text goes that is written.

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
    std::string where;       ///< file:line, key or organ; where to look
    std::string problem;     ///< what is wrong
    std::string why;         ///< what rule it breaks; may be empty
    std::string suggestion;  ///< what to do; may be empty

    [[nodiscard]] std::string text() const;
};

/// Something that is allowed but probably not meant.
struct Warning {
    std::string where, text;
};

/// Thrown for what a person can mend; carries all faults found, at least one.
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
    /// In the order in which they were added.
    [[nodiscard]] const std::vector<Fault>& all() const { return faults_; }
    /// Throws an InputError if there are any.
    void throw_if_any() const;

  private:
    std::vector<Fault> faults_;
};

/// A file that a run was made from.
struct InputFile {
    std::string path;  ///< as stated
    std::string absolute_path;
    std::string sha256;  ///< of its bytes, 64 hexadecimal digits
    std::uint64_t bytes = 0;
    bool is_run_file = false;
};

/// Takes text in pieces.
using TextSink = std::function<void(std::string_view)>;

}  // namespace quasimc

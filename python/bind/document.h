#pragma once

#include <string>

#include <pybind11/pybind11.h>

#include "text/document.h"

namespace quasimc::python {

/// A value of a document from a Python object: bool, int, float, str, list, tuple, dict, path,
/// date or time, or a number or an array of numpy. Keys whose value is None are left out. Objects
/// of other types become values that every reader refuses, naming the type.
[[nodiscard]] Node to_node(pybind11::handle object);
/// A str in UTF-8. @throws InputError  if it holds half a character: a lone surrogate, as
/// os.fsdecode makes of bytes that are not UTF-8
[[nodiscard]] std::string text_of(pybind11::handle text);
/// A Python object from a value of a document; dates and times are text.
[[nodiscard]] pybind11::object to_python(const Node& node);

}  // namespace quasimc::python

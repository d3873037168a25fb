#pragma once

#include <string>

#include <pybind11/pybind11.h>

#include "text/document.h"

namespace quasimc::python {

/// A value of a document from a Python object: bool, int, float, str, list, tuple, dict, path,
/// date or time, or a number or an array of numpy. Keys whose value is None are left out. An object
/// of another type becomes a value that every reader refuses by the name of its type.
[[nodiscard]] Node to_node(pybind11::handle object);
/// A str in UTF-8. @throws InputError  if it holds half a character: a lone surrogate, as
/// os.fsdecode makes of bytes that are not UTF-8
[[nodiscard]] std::string text_of(pybind11::handle text);
/// The other way: dates and times as text.
[[nodiscard]] pybind11::object to_python(const Node& node);

}  // namespace quasimc::python

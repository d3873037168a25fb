#include "document.h"

#include <string>
#include <utility>

#include "quasimc/error.h"

namespace quasimc::python {
namespace {

namespace py = pybind11;

Node to_node_at(py::handle object, int depth);

Node table_node(const py::dict& dict, int depth) {
    Node::Table table;
    for (const auto& [key, value] : dict) {
        if (!value.is_none()) {
            table.push_back({text_of(py::str(key)), 0, to_node_at(value, depth + 1)});
        }
    }
    return {std::move(table)};
}

Node list_node(py::handle sequence, int depth) {
    Node::List list;
    for (const py::handle item : sequence) {
        list.push_back(to_node_at(item, depth + 1));
    }
    return {std::move(list)};
}

Node integer_node(py::handle object) {
    int overflow = 0;
    const long long value = PyLong_AsLongLongAndOverflow(object.ptr(), &overflow);
    if (overflow != 0) {
        return {Node::Other{"an integer that is too large"}};
    }
    return {static_cast<std::int64_t>(value)};
}

/// A value from a duck-typed object.
Node node_by_attributes(py::handle object, int depth) {
    for (const char* method : {"isoformat", "__fspath__"}) {
        if (py::hasattr(object, method)) {
            return {std::string(py::str(object.attr(method)()))};
        }
    }
    if (py::hasattr(object, "tolist")) {  // numpy's arrays and numbers
        return to_node_at(object.attr("tolist")(), depth + 1);
    }
    const std::string type = py::str(py::type::handle_of(object).attr("__name__"));
    return {Node::Other{"of the type " + type}};
}

Node to_node_at(py::handle object, int depth) {
    if (depth > kDeepestNesting) {
        throw InputError({{"", "is nested too deeply", "", ""}});
    }
    if (py::isinstance<py::bool_>(object)) {
        return {object.cast<bool>()};
    }
    if (py::isinstance<py::int_>(object)) {
        return integer_node(object);
    }
    if (PyFloat_CheckExact(object.ptr()) != 0) {
        return {object.cast<double>()};
    }
    if (py::isinstance<py::str>(object)) {
        return {text_of(object)};
    }
    if (py::isinstance<py::dict>(object)) {
        return table_node(py::reinterpret_borrow<py::dict>(object), depth);
    }
    if (py::isinstance<py::list>(object) || py::isinstance<py::tuple>(object)) {
        return list_node(object, depth);
    }
    return node_by_attributes(object, depth);
}

}  // namespace

std::string text_of(py::handle text) {
    Py_ssize_t size = 0;
    const char* bytes = PyUnicode_AsUTF8AndSize(text.ptr(), &size);
    if (bytes == nullptr) {
        PyErr_Clear();
        const std::string ascii =
            py::str(py::reinterpret_steal<py::object>(PyObject_ASCII(text.ptr())));
        throw InputError(
            {{"", "the text " + ascii + " can't be written in UTF-8",
              "it holds a lone surrogate, which is half a character",
              "decode the bytes by the encoding that they are in"}});
    }
    return {bytes, static_cast<std::size_t>(size)};
}

Node to_node(py::handle object) {
    return to_node_at(object, 0);
}

py::object to_python(const Node& node) {
    if (const auto* table = node.as<Node::Table>()) {
        py::dict dict;
        for (const Member& member : *table) {
            dict[py::str(member.key)] = to_python(member.node);
        }
        return dict;
    }
    if (const auto* list = node.as<Node::List>()) {
        py::list items;
        for (const Node& item : *list) {
            items.append(to_python(item));
        }
        return items;
    }
    if (const auto* other = node.as<Node::Other>()) {
        return py::str(other->text);
    }
    if (const auto* boolean = node.as<bool>()) {
        return py::bool_(*boolean);
    }
    if (const auto* integer = node.as<std::int64_t>()) {
        return py::int_(*integer);
    }
    if (const auto* real = node.as<double>()) {
        return py::float_(*real);
    }
    return py::str(*node.as<std::string>());
}

}  // namespace quasimc::python

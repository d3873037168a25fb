// What pugixml finds in the nodes of an .opf file: opf_values FILE prints, for each node, a line
// "id tab name tab text" for each of its attributes.

#include <cstdio>

#include <pugixml.hpp>

namespace {

/// Prints the attributes of every node.
struct NodePrinter : pugi::xml_tree_walker {
    bool for_each(pugi::xml_node& element) override {
        const pugi::xml_node node = element.parent();
        const bool is_attribute = node.attribute("class") && node.attribute("id") &&
                                  element.type() == pugi::node_element &&
                                  !element.attribute("class");
        if (is_attribute) {
            std::printf(
                "%s\t%s\t%s\n", node.attribute("id").value(), element.name(), element.text().get());
        }
        return true;
    }
};

}  // namespace

int main(int count, char** words) {
    pugi::xml_document document;
    if (count != 2) {
        return 2;
    }
    const pugi::xml_parse_result parsed = document.load_file(words[1]);
    if (!parsed) {
        std::fprintf(stderr, "%s: %s\n", words[1], parsed.description());
        return 1;
    }
    NodePrinter printer;
    return document.child("opf").child("topology").traverse(printer) ? 0 : 1;
}

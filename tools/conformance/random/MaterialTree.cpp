// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/random/MaterialTree.h"

#include <cctype>

namespace filament_core::conformance {
namespace {

void printList(MaterialTree const& list, std::string& out);

void printTree(MaterialTree const& tree, std::string& out) {
    if (tree.isList()) return printList(tree, out);
    for (size_t i = 0; i < tree.text.size(); ++i) {
        const bool isHole = tree.text[i] == '$' && i + 1 < tree.text.size() &&
                            std::isdigit(static_cast<unsigned char>(tree.text[i + 1])) != 0;
        if (!isHole) {
            out += tree.text[i];
            continue;
        }
        const auto child = static_cast<size_t>(tree.text[++i] - '0');
        if (child < tree.children.size()) printTree(tree.children[child], out);
    }
}

void printList(MaterialTree const& list, std::string& out) {
    for (size_t i = 0; i < list.children.size(); ++i) {
        if (i > 0) out += list.joint;
        printTree(list.children[i], out);
    }
}

} // namespace

std::string print(MaterialTree const& tree) {
    std::string out;
    printTree(tree, out);
    return out;
}

size_t sizeOf(MaterialTree const& tree) {
    size_t size = 1;
    for (MaterialTree const& child : tree.children) size += sizeOf(child);
    return size;
}

} // namespace filament_core::conformance

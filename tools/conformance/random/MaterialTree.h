// SPDX-License-Identifier: Apache-2.0
/// MaterialTree: the text of a material as a tree, which a generator builds and a reducer cuts.
///   Text     `$0` to `$9` stand for the children. A list has no text: its children follow each other, with `joint`
///            between them, and any of them may be missing.
///   Types    an expression names its GLSL type, so that another expression can take its place; others have none.
///   Thread   any; plain values.
#pragma once

#include <string>
#include <vector>

namespace filament_core::conformance {

struct MaterialTree {
    std::string type;  ///< "vec3"; empty: not an expression
    std::string text;  ///< with $0 to $9; empty: a list
    std::string joint; ///< of a list
    std::vector<MaterialTree> children;

    bool isList() const { return text.empty(); }
    bool isExpression() const { return !type.empty(); }
};

inline MaterialTree listOf(std::string joint) { return { {}, {}, std::move(joint), {} }; }
inline MaterialTree piece(std::string text, std::vector<MaterialTree> children = {}) {
    return { {}, std::move(text), {}, std::move(children) };
}
inline MaterialTree expression(std::string type, std::string text, std::vector<MaterialTree> children = {}) {
    return { std::move(type), std::move(text), {}, std::move(children) };
}

std::string print(MaterialTree const& tree);
/// The number of trees in it, including itself.
size_t sizeOf(MaterialTree const& tree);

} // namespace filament_core::conformance

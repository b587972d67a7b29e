// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/random/RandomCode.h"

#include <fmt/core.h>

#include <array>

namespace filament_core::conformance {
namespace {

constexpr int kMostNesting = 3;

char familyOf(std::string const& type) {
    switch (type[0]) {
    case 'i':
        return 'I';
    case 'u':
        return 'U';
    case 'b':
        return 'B';
    case 'm':
        return 'M';
    default:
        return 'F';
    }
}

} // namespace

std::string randomType(Dice& dice) {
    static constexpr std::array kOften{ "float", "float", "float", "vec2", "vec3", "vec3", "vec4", "int", "bool" };
    static constexpr std::array kSeldom{ "uint",  "ivec2", "ivec3", "ivec4", "uvec2", "uvec4",
                                         "bvec2", "bvec3", "mat2",  "mat3",  "mat4" };
    return dice.chance(80) ? dice.one(kOften) : dice.one(kSeldom);
}

RandomCode::RandomCode(Dice& dice, bool inVertex, int featureLevel) : mDice(dice), mFeatureLevel(featureLevel) {
    for (Production const& production : languageProductions()) {
        const bool isInStage = !inVertex || production.inVertex;
        if (isInStage && production.featureLevel <= featureLevel) addProduction(production);
    }
}

void RandomCode::addLeaf(std::string const& type, std::string const& text) { mLeaves[type].push_back(text); }
void RandomCode::addProduction(Production production) {
    mProductions[production.type].push_back(std::move(production));
}

std::string RandomCode::newName() { return fmt::format("v{}", mNames++); }

MaterialTree RandomCode::scalar(std::string const& type) {
    static constexpr std::array kFloats{ "0.0", "1.0",  "0.5",   "-1.0", "2.0",    "3.0",  "0.25", "-0.5",
                                         "0.1", "3.14", "-2.75", "17.3", "0.0013", "1e10", "-1e20" };
    static constexpr std::array kInts{ "0", "1", "2", "3", "-1", "5", "7", "31", "32", "255", "-1000", "2147483647" };
    static constexpr std::array kUints{ "0u", "1u", "2u", "3u", "8u", "31u", "32u", "65535u", "4294967295u" };
    static constexpr std::array kBools{ "true", "false" };
    const char family = familyOf(type);
    const char* text = family == 'I'   ? mDice.one(kInts)
                       : family == 'U' ? mDice.one(kUints)
                       : family == 'B' ? mDice.one(kBools)
                                       : mDice.one(kFloats);
    return conformance::expression(type, text[0] == '-' ? fmt::format("({})", text) : text);
}

MaterialTree RandomCode::constant(std::string const& type) {
    const int components = componentsOf(type);
    if (components == 1) return scalar(type);
    std::string text = type + "(";
    const char family = familyOf(type);
    const int count = family == 'M' ? components * components : components;
    for (int i = 0; i < count; ++i)
        text += fmt::format("{}{}", i > 0 ? ", " : "", scalar(typeName(family == 'M' ? 'F' : family, 1)).text);
    return conformance::expression(type, text + ")");
}

MaterialTree RandomCode::leaf(std::string const& type) {
    const auto found = mLeaves.find(type);
    if (found == mLeaves.end() || mDice.chance(15)) return constant(type);
    return conformance::expression(type, mDice.one(found->second));
}

// GLSL refuses a constant that is out of range; `zero` is no constant for it.
MaterialTree RandomCode::index() {
    if (mDice.chance(50)) return conformance::expression("index", mDice.chance(50) ? "0" : "1");
    return conformance::expression("index", "zero + $0", { expression("int", 2) });
}

MaterialTree RandomCode::expression(std::string const& type, int depth) {
    const auto found = mProductions.find(type);
    if (depth <= 0 || found == mProductions.end() || mDice.chance(12)) return leaf(type);
    Production const& chosen = mDice.one(found->second);
    const Production production = chosen; // helper() may add others meanwhile
    MaterialTree tree = conformance::expression(type, production.text);
    for (std::string const& argument : production.arguments)
        tree.children.push_back(argument == "index" ? index() : expression(argument, depth - 1));
    return tree;
}

MaterialTree RandomCode::declaration() {
    const std::string type = randomType(mDice), name = newName();
    MaterialTree tree = mDice.chance(5) ? piece(type + " " + name + ";")
                                        : piece(type + " " + name + " = $0;", { expression(type, 4) });
    mVariables.push_back({ type, name });
    addLeaf(type, name);
    addLeaf(type, name); // what the author just named is used more often than the rest
    return tree;
}

MaterialTree RandomCode::array() {
    static constexpr std::array kTypes{ "float", "vec3", "int", "vec4" };
    const std::string type = mDice.one(kTypes), name = newName();
    const int count = 2 + static_cast<int>(mDice.below(4));
    const std::string size = fmt::format("[{}]", count);
    MaterialTree tree = piece(type + " " + name + size + ";");
    if (mDice.chance(85)) {
        std::string list;
        for (int i = 0; i < count; ++i) {
            list += fmt::format("{}${}", i > 0 ? ", " : "", i);
            tree.children.push_back(expression(type, 2));
        }
        tree.text = type + " " + name + size + " = " + type + size + "(" + list + ");";
    }
    addProduction({ type, name + "[$0]", { "index" } });
    addLeaf(type, name + "[1]");
    mVariables.push_back({ type, name + "[0]" });
    return tree;
}

MaterialTree RandomCode::assignment() {
    if (mVariables.empty()) return declaration();
    const Variable variable = mDice.one(mVariables);
    const char family = familyOf(variable.type);
    const int components = componentsOf(variable.type);
    if (family == 'F' && components > 1 && mDice.chance(40)) {
        if (mDice.chance(50)) return piece(variable.name + ".yx = $0;", { expression("vec2", 3) });
        return piece(variable.name + "[$0] = $1;", { index(), expression("float", 3) });
    }
    static constexpr std::array kOperators{ " = ", " = ", " += ", " *= ", " -= " };
    const std::string assign = family == 'B' ? " = " : mDice.one(kOperators);
    return piece(variable.name + assign + "$0;", { expression(variable.type, 4) });
}

MaterialTree RandomCode::branch(int nesting) {
    MaterialTree condition = expression("bool", 3);
    if (mDice.chance(50)) return piece("if ($0) {\n$1\n}", { condition, block(1 + mDice.below(3), nesting + 1) });
    MaterialTree yes = block(1 + mDice.below(2), nesting + 1);
    return piece("if ($0) {\n$1\n} else {\n$2\n}", { condition, yes, block(1 + mDice.below(2), nesting + 1) });
}

MaterialTree RandomCode::loop(int nesting) {
    const std::string name = newName(), rounds = std::to_string(1 + mDice.below(6));
    const auto leaves = mLeaves;
    addLeaf("int", name);
    MaterialTree early = listOf("\n");
    if (mDice.chance(30)) early.children.push_back(piece("if ($0) break;", { expression("bool", 2) }));
    if (mDice.chance(15)) early.children.push_back(piece("if ($0) continue;", { expression("bool", 2) }));
    MaterialTree condition = expression("bool", 2);
    MaterialTree body = block(1 + mDice.below(2), nesting + 1);
    mLeaves = leaves;
    switch (mDice.below(3)) {
    case 0:
        return piece("int " + name + " = 0;\nwhile (" + name + "++ < " + rounds + " && $0) {\n$1\n$2\n}",
                     { condition, early, body });
    case 1:
        return piece("int " + name + " = 0;\ndo {\n$0\n$1\n} while (++" + name + " < " + rounds + ");",
                     { early, body });
    default:
        return piece("for (int " + name + " = 0; " + name + " < " + rounds + "; ++" + name + ") {\n$0\n$1\n}",
                     { early, body });
    }
}

MaterialTree RandomCode::selection(int nesting) {
    MaterialTree value = expression("int", 2);
    MaterialTree first = block(1, nesting + 1), second = block(1, nesting + 1);
    const std::string end = mDice.chance(80) ? " break;" : "";
    return piece("switch ($0) {\ncase 0: {\n$1\n}" + end + "\ncase 1: {\n$2\n} break;\ndefault: {\n$3\n}\n}",
                 { value, first, second, block(1, nesting + 1) });
}

MaterialTree RandomCode::statement(int nesting) {
    const uint32_t roll = mDice.below(100);
    if (nesting < kMostNesting) {
        if (roll < 12) return branch(nesting);
        if (roll < 20) return loop(nesting);
        if (roll < 23) return selection(nesting);
    }
    if (roll < 30) return array();
    return roll < 65 ? declaration() : assignment();
}

MaterialTree RandomCode::block(size_t count, int nesting) {
    const auto productions = mProductions;
    const auto leaves = mLeaves;
    const auto variables = mVariables;
    MaterialTree list = listOf("\n");
    for (size_t i = 0; i < count; ++i) list.children.push_back(statement(nesting));
    if (nesting == 0) return list; // what follows the outermost block sees its variables
    mProductions = productions, mLeaves = leaves, mVariables = variables;
    return list;
}

MaterialTree RandomCode::wholeBlock(size_t count) {
    MaterialTree list = block(count);
    list.children.insert(list.children.begin(), piece("int zero = 0;"));
    return list;
}

MaterialTree RandomCode::helper(std::string const& name) {
    const std::string type = randomType(mDice), first = randomType(mDice), second = randomType(mDice);
    RandomCode inside(mDice, true, mFeatureLevel);
    inside.addLeaf(first, "a");
    inside.addLeaf(second, "b");
    inside.mVariables = { { first, "a" }, { second, "b" } };
    inside.mNames = 100;
    MaterialTree body = inside.wholeBlock(1 + mDice.below(3));
    MaterialTree early = listOf("\n");
    if (mDice.chance(30))
        early.children.push_back(
                piece("if ($0) return $1;", { inside.expression("bool", 2), inside.expression(type, 2) }));
    MaterialTree result = inside.expression(type, 3);
    addProduction({ type, name + "($0, $1)", { first, second } });
    addProduction({ type, name + "($0, $1)", { first, second } });
    return piece(type + " " + name + "(" + first + " a, " + second + " b) {\n$0\n$1\nreturn $2;\n}\n",
                 { body, early, result });
}

} // namespace filament_core::conformance

// SPDX-License-Identifier: Apache-2.0
/// RandomCode: random expressions and statements for one block of a material.
///   In       what the block can name: variables, inputs, parameters.
///   Limits   statements are nested at most 3 deep, expressions at most as deep as asked; loops end after 6 rounds.
///   Thread   one at a time; the same dice give the same code.
#pragma once

#include "tools/conformance/random/Dice.h"
#include "tools/conformance/random/MaterialTree.h"
#include "tools/conformance/random/Productions.h"

#include <map>

namespace filament_core::conformance {

class RandomCode {
public:
    RandomCode(Dice& dice, bool inVertex, int featureLevel);

    /// Something without arguments that expressions may use from now on.
    void addLeaf(std::string const& type, std::string const& text);
    void addProduction(Production production);

    MaterialTree expression(std::string const& type, int depth);
    /// The first `count` statements of a function; expressions may use its variables from now on.
    MaterialTree wholeBlock(size_t count);
    /// A function `name` that expressions may call from now on, as text to put before the block.
    MaterialTree helper(std::string const& name);

private:
    struct Variable {
        std::string type, name;
    };

    MaterialTree constant(std::string const& type);
    MaterialTree scalar(std::string const& type);
    MaterialTree block(size_t count, int nesting = 0);
    MaterialTree index();
    MaterialTree leaf(std::string const& type);
    MaterialTree statement(int nesting);
    MaterialTree declaration();
    MaterialTree array();
    MaterialTree assignment();
    MaterialTree branch(int nesting);
    MaterialTree loop(int nesting);
    MaterialTree selection(int nesting);
    std::string newName();

    Dice& mDice;
    const int mFeatureLevel;
    std::map<std::string, std::vector<Production>> mProductions; // by the type of the result
    std::map<std::string, std::vector<std::string>> mLeaves;
    std::vector<Variable> mVariables; // those that may be written
    int mNames = 0;
};

/// A type that an expression may have.
std::string randomType(Dice& dice);

} // namespace filament_core::conformance

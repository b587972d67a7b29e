// SPDX-License-Identifier: Apache-2.0
/// reduceMaterial: the smallest material found that still fails (delta debugging: Zeller and Hildebrandt 2002,
/// "Simplifying and Isolating Failure-Inducing Input", on a tree instead of a sequence).
///   Steps    removes ranges of lists, halving them; replaces expressions by a constant or by one of their own parts of
///            the same type; replaces a statement by its blocks. Until nothing applies.
///   In       stillFails(text): whether a candidate shows the same failure. One that does not compile does not.
///   Limits   `tries` calls of stillFails.
///   Thread   that of stillFails. Fails: never; at worst the material comes back as it was.
#pragma once

#include "tools/conformance/random/MaterialTree.h"

#include <functional>

namespace filament_core::conformance {

using StillFails = std::function<bool(std::string const& text)>;

struct Reduction {
    MaterialTree material;
    size_t tries = 0; ///< used
};

Reduction reduceMaterial(MaterialTree material, StillFails const& stillFails, size_t tries = 600);

} // namespace filament_core::conformance

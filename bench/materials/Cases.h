// SPDX-License-Identifier: Apache-2.0
/// Cases: what each row of the cost table changes in base.mat, and what the reference text says it costs.
#pragma once

#include "tools/materials/MaterialFile.h"

#include <string>
#include <vector>

namespace filament::bench {

struct CostCase {
    std::string name;
    std::vector<tools::TextEdit> edits;
    std::string reference; ///< ratio to the standard model in the reference text; empty: it says none
};

/// The first is the standard model.
std::vector<CostCase> costCases();

} // namespace filament::bench

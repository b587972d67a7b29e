// SPDX-License-Identifier: Apache-2.0
/// Messages: lines for the user, in their order. What would be said in every frame is said once.
#pragma once

#include "base/Result.h"

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace filament_core::view {

class Messages {
public:
    void add(std::string line) { mLines.push_back(std::move(line)); }
    void addOnce(std::string const& line) {
        if (mKnown.insert(line).second) add(line);
    }
    void addOnce(Result<void> const& result) {
        if (!result) addOnce(result.error().message);
    }
    /// What was said once may be said again: of another model.
    void forget() { mKnown.clear(); }
    std::vector<std::string> take() { return std::exchange(mLines, {}); }

private:
    std::vector<std::string> mLines;
    std::set<std::string> mKnown;
};

} // namespace filament_core::view

// SPDX-License-Identifier: Apache-2.0
/// Diagnostics: errors and warnings while reading one file.
///   The first error wins: code after it may continue with harmless defaults and check once at the end of its step,
///   instead of unwinding from every field. Each warning is kept once, in order of discovery.
///   Thread  one thread each; jobs fill their own and the loader merges them in file order, so the text does not depend
///           on scheduling.
///   Limits  64 warnings; one closing line counts the rest.
#pragma once

#include "base/Result.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace filament_core::assets {

class Diagnostics {
public:
    static constexpr size_t kMaxWarnings = 64;

    bool ok() const { return !mError.has_value(); }
    Error const& error() const { return *mError; }

    void refuse(Error error) {
        if (!mError) mError = std::move(error);
    }

    template <class... Args>
    void refuse(ErrorCode code, fmt::format_string<Args...> format, Args&&... args) {
        if (!mError) mError = fail(code, format, std::forward<Args>(args)...);
    }

    template <class... Args>
    void warn(fmt::format_string<Args...> format, Args&&... args) {
        addWarning(fmt::format(format, std::forward<Args>(args)...));
    }

    void merge(Diagnostics&& other) {
        if (other.mError) refuse(std::move(*other.mError));
        for (std::string& line : other.mWarnings) addWarning(std::move(line));
        mDropped += other.mDropped;
    }

    /// The warnings, and a count of those beyond the limit.
    std::vector<std::string> takeWarnings() {
        if (mDropped > 0) mWarnings.push_back(fmt::format("{} more warnings are not shown", mDropped));
        mDropped = 0;
        return std::exchange(mWarnings, {});
    }

private:
    void addWarning(std::string line) {
        if (std::find(mWarnings.begin(), mWarnings.end(), line) != mWarnings.end()) return;
        if (mWarnings.size() < kMaxWarnings) {
            mWarnings.push_back(std::move(line));
        } else {
            ++mDropped;
        }
    }

    std::optional<Error> mError;
    std::vector<std::string> mWarnings;
    size_t mDropped = 0;
};

} // namespace filament_core::assets

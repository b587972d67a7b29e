// SPDX-License-Identifier: Apache-2.0
/// A variable of the environment, and its value as it was before once this goes.
///   Thread  none other reads the environment meanwhile.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace filament_core::test {

class ScopedVariable {
public:
    /// Without a value it is unset.
    ScopedVariable(const char* name, std::optional<std::string> const& value) : mName(name) {
        if (const char* before = std::getenv(name)) mBefore = before;
        set(value);
    }
    ScopedVariable(ScopedVariable const&) = delete;
    ScopedVariable& operator=(ScopedVariable const&) = delete;
    ~ScopedVariable() { set(mBefore); }

    void set(std::optional<std::string> const& value) const {
        value ? ::setenv(mName, value->c_str(), 1) : ::unsetenv(mName);
    }
    std::optional<std::string> const& before() const { return mBefore; }

private:
    const char* mName;
    std::optional<std::string> mBefore;
};

} // namespace filament_core::test

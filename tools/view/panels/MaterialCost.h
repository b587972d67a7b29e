// SPDX-License-Identifier: Apache-2.0
/// MaterialCost: what the material of a .mat file costs, as `matc --cost` prints it: the terms in it, and the
/// instructions of each variant. Compiled on a thread of its own; the interface never waits.
///   Thread  one.   Memory: the text of one file.
///   Life    the destructor waits for a compilation that has begun: a second or two.
///   Fails   the text is then what the compiler says, with its line.
#pragma once

#include <filesystem>
#include <future>
#include <string>

namespace filament_core::view {

class MaterialCost {
public:
    /// Whether there is a report of this file: it is a .mat file.
    static bool has(std::filesystem::path const& file);
    /// Of this file, as it is now on the disk; if has() is false: nothing. For each frame that shows the text: looks at
    /// the time of the file and compiles what is new.
    void follow(std::filesystem::path const& file);
    /// Takes what a compilation has found; false: it found nothing since the last call.
    bool poll();
    /// Empty: nothing to say yet. Stays until that of a changed file is known.
    std::string const& text() const { return mText; }
    bool isCompiling() const { return mPending.valid(); }

private:
    std::filesystem::path mFile{};
    std::filesystem::file_time_type mTime{};
    std::future<std::string> mPending{};
    std::string mText{};
};

} // namespace filament_core::view

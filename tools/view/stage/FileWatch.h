// SPDX-License-Identifier: Apache-2.0
/// FileWatch: which files changed on disk, by their time and size.
///   Half-written  a file counts once it is the same in two looks, so that programs can finish writing it.
///   Missing       is a state as any other: a file that goes and comes back has changed.
///   Thread        one.   Cost: a system call for each file and look.   Fails: never.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace filament_core::view {

/// The file and those that it names: buffers and images of a .gltf, includes of a .mat. In any order; what cannot be
/// read names none.
std::vector<std::filesystem::path> filesOf(std::filesystem::path const& file);

class FileWatch {
public:
    /// From now on these, as they are now; those that were watched already as they were.
    void watch(std::vector<std::filesystem::path> const& files);
    /// Looks. Files that have another state than before, and had it in the last look, too.
    std::vector<std::filesystem::path> changed();

private:
    struct State {
        bool exists = false;
        int64_t time = 0;
        uintmax_t size = 0;
        friend bool operator==(State const&, State const&) = default;
    };
    struct Watched {
        State known, seen;
    };
    static State stateOf(std::filesystem::path const& file);

    std::map<std::filesystem::path, Watched> mFiles;
};

} // namespace filament_core::view

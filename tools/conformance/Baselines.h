// SPDX-License-Identifier: Apache-2.0
/// Baselines: stored images, as a hash and a thumbnail each, with the machine that produced them.
///   Rule    with the same driver, and with the versions of Mesa that the file lists, the hash must match on every
///           x86-64 processor with AVX and FMA; each version has the hashes of cases that have other bits there.
///           Otherwise the thumbnails are compared with FLIP, which the report shows. A case without a baseline fails:
///           store one with --update-baselines.
///   File    tests/conformance/baselines.json: one machine, the other versions (scripts/check_drivers --write), every
///           case as a hash and 16 x 16 RGB.
///   Thread  one.  Fails  Unreadable, Corrupt with the path.
#pragma once

#include "tools/conformance/Results.h"

#include <filament_core/Image.h>

#include <map>
#include <optional>
#include <string>

namespace filament_core::conformance {

inline constexpr uint32_t kThumbnail = 16; ///< pixels per side
inline constexpr double kThumbnailFlip = 0.02;

struct Machine {
    std::string device, driver;
    std::string cpuFeatures; ///< tools::cpuFeatures(): images have the bits of this class
    friend bool operator==(Machine const&, Machine const&) = default;
};
Machine thisMachine(std::string device, std::string driver);

struct BaselineVerdict {
    bool passed = false;
    std::string text; ///< "equal", "missing", "equal by FLIP 0.003 (made on ...)"
};

class Baselines {
public:
    /// A missing file counts as one without cases.
    static Result<Baselines> read(std::filesystem::path const& file);
    Result<void> write(std::filesystem::path const& file) const;

    BaselineVerdict check(std::string const& name, Image const& image, Machine const& machine) const;
    /// Drops all cases if they are from another machine.
    void store(std::string const& name, Image const& image, Machine const& machine);

private:
    struct Entry {
        std::string hash, thumbnail; ///< hexadecimal
    };
    /// None: nothing is known of the bits that this machine draws.
    std::optional<std::string> hashFor(std::string const& name, Entry const& entry, Machine const& machine) const;

    Machine mMachine;
    std::map<std::string, std::map<std::string, std::string>> mVersions; ///< of Mesa -> case -> hash, where it differs
    std::map<std::string, Entry> mEntries;
};

std::string hashOf(Image const& image);
/// Box-filtered sRGB codes, RGBA8; half floats are first clamped and encoded.
Image thumbnailOf(Image const& image);

} // namespace filament_core::conformance

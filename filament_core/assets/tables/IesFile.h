// SPDX-License-Identifier: Apache-2.0
/// IesFile: the light distribution of a luminaire, as manufacturers publish it: ANSI/IES LM-63 of 1986, 1991, 1995,
/// 2002 and 2019.
///   In      the bytes of a file.   Out: candelas over a grid of angles.
///   Read    photometric types A, B and C; any symmetry; angles at any distances; TILT=NONE and TILT=INCLUDE, of which
///           the factor of an untilted luminaire counts. Types A and B with one horizontal angle become type C: a
///           luminaire of revolution. Keywords, lamps, sizes and watts are not used.
///   Units   degrees; candelas, times the multiplier and ballast factors of the file.
///   Limits  16 MiB; 8192 angles each way and 2^20 candelas; 1e9 cd.
///   Fails   Corrupt, Unsupported: name, line, what was found, what was expected.
///   Thread  any; pure. Memory: 4 B per candela, at most a few times the file. Never crashes: tests/fuzz/IesFuzz.cpp
#pragma once

#include "base/Result.h"

#include <filament_core/Math.h>

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace filament_core::assets {

/// How the two angles of a file name a direction. The frame is that of EXT_lights_ies: both angles zero is forward, -Z;
/// the vertical angle grows from there towards +X at horizontal angle zero.
enum class IesType : uint8_t {
    A, ///< vertical: latitude towards +X, of [-90, 90]; horizontal: longitude around X, towards -Y
    B, ///< horizontal: latitude towards -Y, of [-90, 90]; vertical: longitude around Y, towards +X
    C, ///< vertical: the angle to forward, of [0, 180]; horizontal: around +Z, counter-clockwise, from +X
};

struct IesFile {
    IesType type = IesType::C;
    std::vector<double> vertical, horizontal; ///< degrees, ascending; two verticals at least, one horizontal
    std::vector<float> candelas;              ///< [horizontal * vertical.size() + vertical], >= 0
    float peak = 0;                           ///< the largest, > 0

    /// Bilinear in the angles of the file, with its symmetry; 0 beyond its vertical angles, and beyond the horizontal
    /// ones of types A and B. `direction`: unit, in the frame above.
    double candelasAt(double3 const& direction) const;
};

Result<IesFile> readIes(std::span<const std::byte> bytes, std::string_view name);

} // namespace filament_core::assets

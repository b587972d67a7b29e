// SPDX-License-Identifier: Apache-2.0
/// Shared by the reader and the writer of the package format, which docs/package-format.md describes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace filament_core::shader::format {

constexpr uint32_t tag(const char (&text)[5]) {
    return static_cast<uint32_t>(static_cast<uint8_t>(text[0])) |
           static_cast<uint32_t>(static_cast<uint8_t>(text[1])) << 8 |
           static_cast<uint32_t>(static_cast<uint8_t>(text[2])) << 16 |
           static_cast<uint32_t>(static_cast<uint8_t>(text[3])) << 24;
}

inline constexpr uint32_t kMagic = tag("FMAT");
inline constexpr uint32_t kVersion = 13;   ///< incremented when old readers would misread a file
inline constexpr size_t kHeaderBytes = 16; ///< magic, version, checksum of everything after the header

inline constexpr uint32_t kSectionGeneral = tag("GENL");
inline constexpr uint32_t kSectionParameters = tag("PARM");
inline constexpr uint32_t kSectionConstants = tag("CNST");
inline constexpr uint32_t kSectionTerms = tag("TERM");
inline constexpr uint32_t kSectionLayout = tag("LAYT");
inline constexpr uint32_t kSectionCode = tag("CODE");
inline constexpr uint32_t kSectionVariants = tag("VARI");

/// Of the filtered variants, where it is no VariantBit: MaterialPackage::sectionPlanes.
inline constexpr uint16_t kSectionPlanesFlag = 1 << 15;

inline constexpr uint32_t kMaxParameters = 1024;
inline constexpr uint32_t kMaxConstants = 1024;
inline constexpr uint32_t kMaxTerms = 64;
/// Code is compressed and shared by variants, so a small file can stand for a lot of it. Limits both the unpacked
/// section and the sum over all variants. Not a multiple of the file's size: anything that was read can be written.
inline constexpr uint32_t kMaxCodeBytes = 64 << 20;
inline constexpr uint32_t kMaxVariants = 512; ///< every set of the VariantBits of surfaces

} // namespace filament_core::shader::format

// SPDX-License-Identifier: Apache-2.0
/// What reader and writer of the package format share; the format is described in docs/package-format.md.
#pragma once

#include <cstddef>
#include <cstdint>

namespace filament::shader::format {

constexpr uint32_t tag(const char (&text)[5]) {
    return static_cast<uint32_t>(static_cast<uint8_t>(text[0])) |
           static_cast<uint32_t>(static_cast<uint8_t>(text[1])) << 8 |
           static_cast<uint32_t>(static_cast<uint8_t>(text[2])) << 16 |
           static_cast<uint32_t>(static_cast<uint8_t>(text[3])) << 24;
}

inline constexpr uint32_t kMagic = tag("FMAT");
inline constexpr uint32_t kVersion = 8;    ///< counts up when old readers would misunderstand a file
inline constexpr size_t kHeaderBytes = 16; ///< magic, version, checksum of everything behind the header

inline constexpr uint32_t kSectionGeneral = tag("GENL");
inline constexpr uint32_t kSectionParameters = tag("PARM");
inline constexpr uint32_t kSectionConstants = tag("CNST");
inline constexpr uint32_t kSectionTerms = tag("TERM");
inline constexpr uint32_t kSectionLayout = tag("LAYT");
inline constexpr uint32_t kSectionCode = tag("CODE");
inline constexpr uint32_t kSectionVariants = tag("VARI");

inline constexpr uint32_t kMaxParameters = 1024;
inline constexpr uint32_t kMaxConstants = 1024;
inline constexpr uint32_t kMaxTerms = 64;
/// Code is compressed, and variants share it, so a small file can stand for much of it: at most so many bytes as it
/// lies in the section, and at most so many in all variants together. Not a multiple of the file: what was read can be
/// written.
inline constexpr uint32_t kMaxCodeBytes = 64 << 20;
inline constexpr uint32_t kMaxVariants = 512; ///< every set of VariantBits

} // namespace filament::shader::format

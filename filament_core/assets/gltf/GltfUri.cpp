// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfUri.h"

#include "base/AsciiText.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>

namespace filament_core::assets {
namespace {

constexpr uint64_t kMaxUriFileBytes = uint64_t{ 2 } << 30;

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/// RFC 3986, section 2.1. A '%' that starts no escape is kept: exporters forget to encode it.
std::string percentDecoded(std::string_view text) {
    std::string decoded;
    decoded.reserve(text.size());
    for (size_t i = 0; i < text.size(); ++i) {
        const bool isEscape =
                text[i] == '%' && i + 2 < text.size() && hexDigit(text[i + 1]) >= 0 && hexDigit(text[i + 2]) >= 0;
        decoded.push_back(isEscape ? static_cast<char>(hexDigit(text[i + 1]) * 16 + hexDigit(text[i + 2])) : text[i]);
        if (isEscape) i += 2;
    }
    return decoded;
}

/// RFC 4648, section 4; the URL alphabet of section 5 is accepted too.
constexpr std::array<int8_t, 256> base64Values() {
    std::array<int8_t, 256> values{};
    values.fill(-1);
    constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < kAlphabet.size(); ++i) values[static_cast<uint8_t>(kAlphabet[i])] = static_cast<int8_t>(i);
    values['-'] = 62;
    values['_'] = 63;
    return values;
}

constexpr std::string_view kUriBlanks = " \t\r\n\f";

bool isUriBlank(char c) { return kUriBlanks.find(c) != kUriBlanks.npos; }

/// Line breaks and blanks, which encoders of MIME and editors put in, count for nothing, and padding ends the data.
Result<std::vector<std::byte>> base64Decoded(std::string_view text) {
    static constexpr std::array<int8_t, 256> kValues = base64Values();
    std::string decoded; // percent-encoded: "+", "/" and "=" are reserved in a URI
    if (text.find('%') != std::string_view::npos) text = decoded = percentDecoded(text);
    while (!text.empty() && (text.back() == '=' || isUriBlank(text.back()))) text.remove_suffix(1);
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    uint32_t bits = 0, count = 0;
    for (size_t i = 0; i < text.size(); ++i) {
        if (isUriBlank(text[i])) continue;
        const auto code = static_cast<uint8_t>(text[i]);
        if (kValues[code] < 0)
            return fail(ErrorCode::Corrupt,
                        "the data URI holds a character that is not base64 (code {} at {}); encode it again", code, i);
        bits = bits << 6 | static_cast<uint32_t>(kValues[code]);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<std::byte>(bits >> count & 0xFF));
    }
    return bytes;
}

/// "base64" is the last parameter (RFC 2397); some writers let a charset follow it.
bool saysBase64(std::string_view mediaType) {
    for (size_t at = mediaType.find(';'); at != std::string_view::npos; at = mediaType.find(';')) {
        mediaType.remove_prefix(at + 1);
        if (lowerCase(withoutBlanks(mediaType.substr(0, mediaType.find(';')), kUriBlanks)) == "base64") return true;
    }
    return false;
}

Result<std::vector<std::byte>> dataUriBytes(std::string_view uri) {
    const size_t comma = uri.find(',');
    if (comma == std::string_view::npos)
        return fail(ErrorCode::Corrupt, "the data URI has no comma before its data; write data:;base64,...");
    if (saysBase64(uri.substr(0, comma))) return base64Decoded(uri.substr(comma + 1));
    const std::string text = percentDecoded(uri.substr(comma + 1));
    auto const* first = reinterpret_cast<const std::byte*>(text.data());
    return std::vector<std::byte>(first, first + text.size());
}

bool hasScheme(std::string_view uri) {
    const size_t colon = uri.find(':');
    return colon != std::string_view::npos && colon < uri.find_first_of("/?#");
}

} // namespace

bool isDataUri(std::string_view uri) {
    constexpr std::string_view kScheme = "data:";
    return lowerCase(withoutBlanks(uri, kUriBlanks).substr(0, kScheme.size())) == kScheme;
}

Result<std::vector<std::byte>> readGltfFile(std::filesystem::path const& path) {
    std::error_code code;
    const std::string shown = path.string();
    if (!std::filesystem::exists(path, code)) return fail(ErrorCode::NotFound, "no file '{}'", shown);
    if (!std::filesystem::is_regular_file(path, code))
        return fail(ErrorCode::Unreadable, "'{}' is not a regular file", shown);
    const uint64_t size = std::filesystem::file_size(path, code);
    if (code || size > kMaxUriFileBytes)
        return fail(ErrorCode::Unreadable, "'{}' is larger than 2 GiB or has no size", shown);
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    std::vector<std::byte> bytes(size);
    if (!file || std::fread(bytes.data(), 1, bytes.size(), file.get()) != bytes.size()) {
        return fail(ErrorCode::Unreadable, "'{}' cannot be read, check its permissions", shown);
    }
    return bytes;
}

Result<std::vector<std::byte>> readGltfUri(std::string_view uri, GltfFolder const& folder) {
    if (isDataUri(uri)) return dataUriBytes(uri);
    if (hasScheme(uri)) {
        return fail(ErrorCode::Unsupported, "'{}' is not a file beside the model; store it there", uri.substr(0, 80));
    }
    if (folder.resolve) return folder.resolve(percentDecoded(uri));
    const Result<std::filesystem::path> file = fileInside(folder.directory, percentDecoded(uri), folder.from);
    if (!file) return file.error();
    return readGltfFile(*file);
}

} // namespace filament_core::assets

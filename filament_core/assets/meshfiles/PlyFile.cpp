// SPDX-License-Identifier: Apache-2.0
// Turk 1994, "The PLY Polygon File Format".
#include "filament_core/assets/meshfiles/MeshFile.h"
#include "filament_core/assets/meshfiles/MeshWords.h"
#include "filament_core/assets/meshfiles/PolygonTriangles.h"

#include <filament_core/Color.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace filament_core::assets {
namespace {

constexpr size_t kMostProperties = 256, kMostElements = 16, kMostVertices = 0xFFFFFFFE;

enum class Number : uint8_t { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float, Double };

std::optional<Number> typeNamed(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, Number>, 16> kNames{ { { "char", Number::Int8 },
                                                                            { "int8", Number::Int8 },
                                                                            { "uchar", Number::Uint8 },
                                                                            { "uint8", Number::Uint8 },
                                                                            { "short", Number::Int16 },
                                                                            { "int16", Number::Int16 },
                                                                            { "ushort", Number::Uint16 },
                                                                            { "uint16", Number::Uint16 },
                                                                            { "int", Number::Int32 },
                                                                            { "int32", Number::Int32 },
                                                                            { "uint", Number::Uint32 },
                                                                            { "uint32", Number::Uint32 },
                                                                            { "float", Number::Float },
                                                                            { "float32", Number::Float },
                                                                            { "double", Number::Double },
                                                                            { "float64", Number::Double } } };
    const auto found = std::ranges::find(kNames, name, &std::pair<std::string_view, Number>::first);
    return found == kNames.end() ? std::nullopt : std::optional(found->second);
}

size_t bytesOf(Number type) {
    constexpr std::array<size_t, 8> kBytes{ 1, 1, 2, 2, 4, 4, 4, 8 };
    return kBytes[static_cast<size_t>(type)];
}

struct Property {
    std::string name{};
    Number type = Number::Float;
    std::optional<Number> count{}; ///< of a list
};

struct Element {
    std::string name{};
    uint64_t count = 0;
    std::vector<Property> properties{};
};

enum class PlyEncoding : uint8_t { Text, Little, Big };

struct Header {
    PlyEncoding encoding = PlyEncoding::Text;
    std::vector<Element> elements{};
};

Result<Property> readProperty(std::string_view words) {
    Property property;
    std::string_view type = takeWord(words);
    if (type == "list") {
        property.count = typeNamed(takeWord(words));
        if (!property.count || *property.count >= Number::Float)
            return fail(ErrorCode::Corrupt, "the header has a list without a type of its length");
        type = takeWord(words);
    }
    const std::optional<Number> number = typeNamed(type);
    property.name = takeWord(words);
    if (!number || property.name.empty())
        return fail(ErrorCode::Corrupt, "the header has a property without a type or a name");
    property.type = *number;
    return property;
}

/// Takes the header.
Result<Header> readHeader(std::string_view& text) {
    if (trimmed(takeLine(text)) != "ply") return fail(ErrorCode::Corrupt, "the file does not begin with \"ply\"");
    Header header;
    bool hasFormat = false;
    while (!text.empty()) {
        std::string_view words = takeLine(text);
        const std::string_view word = takeWord(words);
        if (word == "end_header") {
            if (!hasFormat) return fail(ErrorCode::Corrupt, "the header has no format");
            return header;
        }
        if (word == "format") {
            const std::string_view format = takeWord(words);
            hasFormat = format == "ascii" || format == "binary_little_endian" || format == "binary_big_endian";
            if (!hasFormat || takeWord(words) != "1.0")
                return fail(ErrorCode::Unsupported,
                            "the format is not ascii, binary_little_endian or binary_big_endian "
                            "1.0");
            if (format != "ascii")
                header.encoding = format == "binary_big_endian" ? PlyEncoding::Big : PlyEncoding::Little;
        } else if (word == "element") {
            if (header.elements.size() == kMostElements)
                return fail(ErrorCode::Unsupported, "the header has more than {} elements", kMostElements);
            Element& element = header.elements.emplace_back(Element{ .name = std::string(takeWord(words)) });
            const std::optional<int64_t> count = integerOf(takeWord(words));
            if (!count || *count < 0 || static_cast<uint64_t>(*count) > kMostVertices)
                return fail(ErrorCode::Corrupt, "the header has an element without a number from 0 to {}",
                            kMostVertices);
            element.count = static_cast<uint64_t>(*count);
        } else if (word == "property") {
            Result<Property> property = readProperty(words);
            if (!property) return property.error();
            if (header.elements.empty() || header.elements.back().properties.size() == kMostProperties)
                return fail(ErrorCode::Corrupt, "the header has a property of no element, or more than {}",
                            kMostProperties);
            header.elements.back().properties.push_back(std::move(*property));
        }
    }
    return fail(ErrorCode::Corrupt, "the header has no end");
}

/// The numbers behind the header.
class Numbers {
public:
    Numbers(std::string_view rest, PlyEncoding encoding) : mRest(rest), mEncoding(encoding) {}

    /// False: the data ends, or is no number. What is not finite, or no float would hold, is NaN.
    bool read(Number type, double& value) {
        return mEncoding == PlyEncoding::Text ? readWord(type, value) : readBytes(type, value);
    }
    size_t left() const { return mRest.size(); }

private:
    bool readWord(Number type, double& value) {
        std::string_view word;
        do { // words may go on in the next line
            while (!mRest.empty() && mRest.front() == '\n') mRest.remove_prefix(1);
            const size_t end = mRest.find('\n');
            std::string_view line = mRest.substr(0, end);
            const size_t before = line.size();
            word = takeWord(line);
            mRest.remove_prefix(before - line.size());
        } while (word.empty() && !mRest.empty());
        const std::optional<double> number = doubleOf(word);
        const std::optional<int64_t> integer = integerOf(word); // an index may have more digits than a float
        if (!number) {
            value = std::numeric_limits<double>::quiet_NaN();
            return isNotFinite(word);
        }
        value = integer                  ? static_cast<double>(*integer)
                : type == Number::Double ? *number
                                         : static_cast<double>(static_cast<float>(*number));
        return true;
    }

    /// As C's printf() writes what is not finite, and as that of old Windows does ("-1.#IND"); also 1e99.
    static bool isNotFinite(std::string_view word) {
        if (word.starts_with('+')) word.remove_prefix(1);
        if (word.starts_with("1.#") || word.starts_with("-1.#")) return true;
        double value = 0;
        const char* end = word.data() + word.size();
        return !word.empty() && std::from_chars(word.data(), end, value).ptr == end;
    }

    template <class T>
    T bits() {
        std::array<char, sizeof(T)> bytes; // NOLINT(cppcoreguidelines-pro-type-member-init): copied into
        std::memcpy(bytes.data(), mRest.data(), sizeof(T));
        if (mEncoding == PlyEncoding::Big) std::ranges::reverse(bytes);
        mRest.remove_prefix(sizeof(T));
        return std::bit_cast<T>(bytes);
    }

    bool readBytes(Number type, double& value) {
        if (mRest.size() < bytesOf(type)) return false;
        switch (type) {
        case Number::Int8:
            value = bits<int8_t>();
            break;
        case Number::Uint8:
            value = bits<uint8_t>();
            break;
        case Number::Int16:
            value = bits<int16_t>();
            break;
        case Number::Uint16:
            value = bits<uint16_t>();
            break;
        case Number::Int32:
            value = bits<int32_t>();
            break;
        case Number::Uint32:
            value = bits<uint32_t>();
            break;
        case Number::Float:
            value = static_cast<double>(bits<float>());
            break;
        case Number::Double:
            value = bits<double>();
            break;
        }
        if (!(std::abs(value) < 3e38)) value = std::numeric_limits<double>::quiet_NaN();
        return true;
    }

    std::string_view mRest;
    PlyEncoding mEncoding;
};

/// Where a property of a vertex goes.
enum class Use : uint8_t { X, Y, Z, Nx, Ny, Nz, U, V, Red, Green, Blue, Alpha, Nothing };

Use useOf(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, Use>, 18> kUses{ { { "x", Use::X },
                                                                        { "y", Use::Y },
                                                                        { "z", Use::Z },
                                                                        { "nx", Use::Nx },
                                                                        { "ny", Use::Ny },
                                                                        { "nz", Use::Nz },
                                                                        { "u", Use::U },
                                                                        { "v", Use::V },
                                                                        { "s", Use::U },
                                                                        { "t", Use::V },
                                                                        { "texture_u", Use::U },
                                                                        { "texture_v", Use::V },
                                                                        { "red", Use::Red },
                                                                        { "green", Use::Green },
                                                                        { "blue", Use::Blue },
                                                                        { "alpha", Use::Alpha },
                                                                        { "texcoord_u", Use::U },
                                                                        { "texcoord_v", Use::V } } };
    const auto found = std::ranges::find(kUses, name, &std::pair<std::string_view, Use>::first);
    return found == kUses.end() ? Use::Nothing : found->second;
}

class PlyReader {
public:
    explicit PlyReader(Header const& header, std::string_view rest)
            : mHeader(header), mNumbers(rest, header.encoding) {}

    Result<MeshFile> read() {
        for (Element const& element : mHeader.elements)
            if (Result<void> done = readElement(element); !done) return done.error();
        mPart.arePoints = mPart.indices.empty();
        if (mPart.arePoints) leaveOutUnplaced();
        if (mPart.positions.empty()) return fail(ErrorCode::Unsupported, "the file has no vertices");
        for (const uint32_t index : mPart.indices)
            if (index >= mPart.positions.size())
                return fail(ErrorCode::Corrupt, "a face names vertex {} of {}", index, mPart.positions.size());
        for (const uint32_t index : mPart.indices)
            if (isUnplaced(index)) return fail(ErrorCode::Corrupt, "vertex {} of a face has no finite position", index);
        for (const uint32_t index : mUnplaced) mPart.positions[index] = mPart.positions[mPart.indices[0]];
        return MeshFile{ .parts = { std::move(mPart) } };
    }

private:
    Result<void> readElement(Element const& element) {
        if (element.properties.empty() || element.count == 0) return {};
        if (element.count > mNumbers.left()) // a byte each at least
            return fail(ErrorCode::Corrupt, "{} elements '{}' are not in {} bytes", element.count, safe(element.name),
                        mNumbers.left());
        if (element.name == "vertex") return readVertices(element);
        std::vector<double> list;
        for (uint64_t i = 0; i < element.count; ++i) {
            for (Property const& property : element.properties) {
                if (Result<void> done = readList(property, list, element, i); !done) return done;
                const bool isFace =
                        property.count && (property.name == "vertex_indices" || property.name == "vertex_index");
                if (element.name != "face" || !isFace) continue;
                if (!std::ranges::all_of(list, [](double n) { return n >= 0 && n < double(kMostVertices); }))
                    return fail(ErrorCode::Corrupt, "face {} names a vertex below 0", i);
                addFace(list);
            }
        }
        return {};
    }

    void addFace(std::vector<double> const& list) {
        if (list.size() < 3) return;
        mCorners.clear();
        for (const double index : list) { // of vertices that come after faces, or never, nothing is known
            const auto place = static_cast<uint32_t>(index);
            mCorners.push_back(place < mPart.positions.size() && !isUnplaced(place) ? mPart.positions[place]
                                                                                    : float3(0.0f));
        }
        for (std::array<uint32_t, 3> const& triangle : mTriangles.of(mCorners))
            for (const uint32_t corner : triangle) mPart.indices.push_back(static_cast<uint32_t>(list[corner]));
    }

    bool isUnplaced(uint32_t vertex) const { return std::ranges::binary_search(mUnplaced, vertex); }

    /// Sensors write a point where they saw none.
    void leaveOutUnplaced() {
        if (mUnplaced.empty()) return;
        const auto keep = [&](auto& list) {
            size_t kept = 0;
            for (size_t i = 0; i < list.size(); ++i)
                if (!isUnplaced(static_cast<uint32_t>(i))) list[kept++] = list[i];
            list.resize(kept);
        };
        keep(mPart.positions), keep(mPart.normals), keep(mPart.uvs), keep(mPart.colors);
        mUnplaced.clear();
    }

    static std::string safe(std::string_view word) {
        std::string text(word.substr(0, 32));
        for (char& c : text)
            if (c < ' ' || c > '~') c = '?';
        return text;
    }

    /// A list, or the one number of a property.
    Result<void> readList(Property const& property, std::vector<double>& list, Element const& element, uint64_t index) {
        double count = 1;
        const auto broken = [&] {
            return fail(ErrorCode::Corrupt, "element {} of '{}' ends before its numbers, or has a wrong one", index,
                        safe(element.name));
        };
        if (property.count && !mNumbers.read(*property.count, count)) return broken();
        if (!(count >= 0) || count > static_cast<double>(mNumbers.left())) return broken();
        list.resize(static_cast<size_t>(count));
        for (double& number : list)
            if (!mNumbers.read(property.type, number)) return broken();
        return {};
    }

    Result<void> readVertices(Element const& element) {
        std::array<bool, 13> has{};
        bool hasDoubles = false, hasOrigin = false;
        for (Property const& property : element.properties) {
            if (property.count) continue;
            has[static_cast<size_t>(useOf(property.name))] = true;
            hasDoubles |= property.type == Number::Double && useOf(property.name) <= Use::Z;
        }
        const auto hasAll = [&](Use first, Use last) {
            for (size_t i = size_t(first); i <= size_t(last); ++i)
                if (!has[i]) return false;
            return true;
        };
        if (!hasAll(Use::X, Use::Z)) return fail(ErrorCode::Corrupt, "vertices have no x, y and z");
        const bool normals = hasAll(Use::Nx, Use::Nz), uvs = hasAll(Use::U, Use::V),
                   colors = hasAll(Use::Red, Use::Blue);
        std::vector<double> list;
        for (uint64_t i = 0; i < element.count; ++i) {
            std::array<float, 13> value{};
            double3 place{ 0 };
            value[size_t(Use::Alpha)] = 1;
            for (Property const& property : element.properties) {
                if (Result<void> done = readList(property, list, element, i); !done) return done;
                if (property.count || list.empty()) continue;
                const Use use = useOf(property.name);
                if (use <= Use::Z) place[static_cast<int>(use)] = list[0];
                const double number = std::isfinite(list[0]) ? list[0] : 0;
                value[size_t(use)] = use >= Use::Red && use <= Use::Alpha
                                             ? colorOf(property.type, number, use == Use::Alpha)
                                             : static_cast<float>(number);
            }
            if (!std::isfinite(place.x + place.y + place.z)) {
                mUnplaced.push_back(static_cast<uint32_t>(mPart.positions.size()));
                place = mPart.origin;
            } else if (hasDoubles && !hasOrigin) {
                const double largest = std::max({ std::abs(place.x), std::abs(place.y), std::abs(place.z) });
                if (largest < 1e15) mPart.origin = glm::round(place); // no difference overflows
                hasOrigin = true;
            }
            mPart.positions.emplace_back(place - mPart.origin);
            if (normals) mPart.normals.push_back({ value[3], value[4], value[5] });
            if (uvs) mPart.uvs.push_back({ value[6], 1 - value[7] });
            if (colors) mPart.colors.push_back({ value[8], value[9], value[10], value[11] });
        }
        return {};
    }

    static float colorOf(Number type, double value, bool isAlpha) {
        const double whole = type == Number::Uint8 ? 255 : type == Number::Uint16 ? 65535 : 1;
        const auto share = static_cast<float>(std::clamp(value / whole, 0.0, 1.0));
        return isAlpha || whole == 1 ? share : color::linearFromSrgb(float3(share)).x;
    }

    Header const& mHeader;
    Numbers mNumbers;
    MeshFilePart mPart;
    std::vector<uint32_t> mUnplaced; ///< vertices whose position is not finite, in order
    std::vector<float3> mCorners;    ///< of a face
    PolygonTriangles mTriangles;
};

} // namespace

Result<MeshFile> readPly(std::span<const std::byte> bytes) {
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const Result<Header> header = readHeader(text);
    if (!header) return header.error();
    return PlyReader(*header, text).read();
}

} // namespace filament_core::assets

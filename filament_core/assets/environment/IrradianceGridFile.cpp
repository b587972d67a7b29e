// SPDX-License-Identifier: Apache-2.0
// The file format of irradiance grids, version 1 (docs/irradiance-grids.md).
#include "base/Assert.h"
#include "base/Result.h"
#include "base/math/Half.h"

#include <filament_core/IrradianceGrid.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstring>

namespace filament_core {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

constexpr std::array<char, 4> kGridMagic{ 'F', 'C', 'I', 'G' };
constexpr uint32_t kGridVersion = 1;
constexpr uint32_t kInsideBit = 1;
constexpr size_t kProbeBytes = 2 * (27 + 1 + 1); // coefficients, error, flags
constexpr float kLongestMeters = 1e9f, kBrightest = 1e12f;
constexpr float kDepthSteps = 65535;
constexpr uint32_t kLongestName = 256;

class GridWriter {
public:
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void put(T const& value) {
        const auto bytes = std::as_bytes(std::span(&value, 1));
        mBytes.insert(mBytes.end(), bytes.begin(), bytes.end());
    }
    void putText(std::string_view text) {
        put(static_cast<uint32_t>(text.size()));
        const auto bytes = std::as_bytes(std::span(text));
        mBytes.insert(mBytes.end(), bytes.begin(), bytes.end());
    }
    std::vector<std::byte> take() { return std::move(mBytes); }

private:
    std::vector<std::byte> mBytes;
};

class GridReader {
public:
    explicit GridReader(std::span<const std::byte> bytes) : mLeft(bytes) {}

    template <class T>
    requires std::is_trivially_copyable_v<T> T take() {
        T value{};
        if (mLeft.size() < sizeof(T)) {
            mLeft = {};
            mIsShort = true;
            return value;
        }
        std::memcpy(&value, mLeft.data(), sizeof(T));
        mLeft = mLeft.subspan(sizeof(T));
        return value;
    }
    std::string takeText(uint32_t length) {
        if (mLeft.size() < length) {
            mIsShort = true;
            return {};
        }
        std::string text(reinterpret_cast<char const*>(mLeft.data()), length);
        mLeft = mLeft.subspan(length);
        return text;
    }
    bool isShort() const { return mIsShort; }
    size_t left() const { return mLeft.size(); }

private:
    std::span<const std::byte> mLeft;
    bool mIsShort = false;
};

Error badGrid(std::string_view why) { return fail(ErrorCode::InvalidArgument, "irradiance grid: {}", why); }

bool isWithin(float value, float least, float most) { return value >= least && value <= most; } // false: NaN

struct GridHeader {
    IrradianceGridDesc desc{};
    uint3 count{ 0 };
    uint32_t depthSize = 0;
    float largest = 0, farthest = 0;
};

std::optional<std::string_view> faultOf(GridHeader const& header) {
    IrradianceGridDesc const& desc = header.desc;
    for (int axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(desc.centerWorld[axis])) return "its center is not finite";
        if (!(desc.halfExtentMeters[axis] > 0 && desc.halfExtentMeters[axis] <= kLongestMeters))
            return "half a side of its box is not in (0, 1e9] metres";
        for (int other = 0; other <= axis; ++other) {
            const float product = glm::dot(desc.worldFromBox[axis], desc.worldFromBox[other]);
            if (!(std::abs(product - (axis == other ? 1.0f : 0.0f)) < 1e-3f))
                return "the axes of its box are not unit vectors at right angles";
        }
        if (header.count[axis] == 0 || header.count[axis] > IrradianceProbes::kMaxProbes)
            return "its number of probes is not in [1, 2^20]";
    }
    if (!isWithin(desc.blendMeters, 0, kLongestMeters)) return "its blend distance is not in [0, 1e9] metres";
    if (!isWithin(desc.intensity, 0, kLongestMeters)) return "its intensity is not in [0, 1e9]";
    if (!isWithin(header.largest, 0, kBrightest)) return "its largest coefficient is not in [0, 1e12]";
    if (!isWithin(header.farthest, 0, kLongestMeters)) return "its farthest depth is not in [0, 1e9] metres";
    if (header.depthSize > IrradianceProbes::kMaxDepthSize) return "its depths have more than 32 directions a side";
    if (uint64_t{ header.count.x } * header.count.y > IrradianceProbes::kMaxProbes ||
        uint64_t{ header.count.x } * header.count.y * header.count.z > IrradianceProbes::kMaxProbes)
        return "its number of probes is not in [1, 2^20]";
    return std::nullopt;
}

GridHeader readHeader(GridReader& reader) {
    GridHeader header;
    for (int axis = 0; axis < 3; ++axis) header.desc.centerWorld[axis] = reader.take<double>();
    for (int axis = 0; axis < 3; ++axis) header.desc.halfExtentMeters[axis] = reader.take<float>();
    for (int i = 0; i < 9; ++i) header.desc.worldFromBox[i / 3][i % 3] = reader.take<float>();
    header.desc.blendMeters = reader.take<float>();
    header.desc.intensity = reader.take<float>();
    for (int axis = 0; axis < 3; ++axis) header.count[axis] = reader.take<uint32_t>();
    header.depthSize = reader.take<uint32_t>();
    header.largest = reader.take<float>();
    header.farthest = reader.take<float>();
    return header;
}

/// Infinities and NaNs of damaged files become 0.
float fromHalf(uint16_t half, float scale) {
    const float value = floatFromHalf(half);
    return std::abs(value) <= 1 ? value * scale : 0.0f;
}

IrradianceProbe readProbe(GridReader& reader, float largest) {
    IrradianceProbe probe;
    for (float3& coefficient : probe.irradianceSh)
        for (int channel = 0; channel < 3; ++channel) coefficient[channel] = fromHalf(reader.take<uint16_t>(), largest);
    probe.standardError = std::abs(fromHalf(reader.take<uint16_t>(), largest));
    probe.isInside = (reader.take<uint16_t>() & kInsideBit) != 0;
    return probe;
}

float largestOf(IrradianceProbes const& probes) {
    float largest = 0;
    for (IrradianceProbe const& probe : probes.probes) {
        for (float3 const& coefficient : probe.irradianceSh)
            largest = std::max({ largest, std::abs(coefficient.x), std::abs(coefficient.y), std::abs(coefficient.z) });
        largest = std::max(largest, probe.standardError);
    }
    return largest;
}

uint16_t stepOf(float depth, float farthest) {
    const float share = farthest > 0 ? std::clamp(depth / farthest, 0.0f, 1.0f) : 0.0f;
    return static_cast<uint16_t>(share * kDepthSteps + 0.5f);
}

} // namespace

std::vector<std::byte> writeIrradianceGrid(IrradianceGridDesc const& grid) {
    FILAMENT_ASSERT(grid.probes, "an irradiance grid has probes");
    IrradianceProbes const& probes = *grid.probes;
    GridWriter writer;
    writer.put(kGridMagic);
    writer.put(kGridVersion);
    for (int axis = 0; axis < 3; ++axis) writer.put(grid.centerWorld[axis]);
    for (int axis = 0; axis < 3; ++axis) writer.put(grid.halfExtentMeters[axis]);
    for (int i = 0; i < 9; ++i) writer.put(grid.worldFromBox[i / 3][i % 3]);
    writer.put(grid.blendMeters);
    writer.put(grid.intensity);
    for (int axis = 0; axis < 3; ++axis) writer.put(probes.count[axis]);
    writer.put(probes.depthSize);
    const float largest = largestOf(probes);
    float farthest = 0;
    for (float2 const& depth : probes.depths) farthest = std::max({ farthest, depth.x, std::sqrt(depth.y) });
    writer.put(largest);
    writer.put(farthest);
    writer.putText(std::string_view(grid.name).substr(0, kLongestName));
    const float scale = largest > 0 ? 1 / largest : 0;
    for (IrradianceProbe const& probe : probes.probes) {
        for (float3 const& coefficient : probe.irradianceSh)
            for (int channel = 0; channel < 3; ++channel) writer.put(halfFromFloat(coefficient[channel] * scale));
        writer.put(halfFromFloat(probe.standardError * scale));
        writer.put(static_cast<uint16_t>(probe.isInside ? kInsideBit : 0));
    }
    for (float2 const& depth : probes.depths) {
        writer.put(stepOf(depth.x, farthest));
        writer.put(stepOf(std::sqrt(depth.y), farthest));
    }
    return writer.take();
}

Result<IrradianceGridDesc> readIrradianceGrid(std::span<const std::byte> bytes) {
    GridReader reader(bytes);
    if (reader.take<std::array<char, 4>>() != kGridMagic) return badGrid("this is no such file");
    const auto version = reader.take<uint32_t>();
    if (version != kGridVersion)
        return fail(ErrorCode::InvalidArgument,
                    "irradiance grid: version {} is not known, this engine reads {}: bake it again", version,
                    kGridVersion);
    GridHeader header = readHeader(reader);
    const auto nameLength = reader.take<uint32_t>();
    if (!reader.isShort() && nameLength > kLongestName) return badGrid("its name is longer than 256 bytes");
    header.desc.name = reader.takeText(nameLength);
    if (reader.isShort()) return badGrid("the file is cut short");
    if (const auto fault = faultOf(header)) return badGrid(*fault);
    const size_t count = size_t{ header.count.x } * header.count.y * header.count.z;
    const size_t depths = count * header.depthSize * header.depthSize;
    if (reader.left() != count * kProbeBytes + depths * 4)
        return badGrid("the file has another size than its header says");

    const auto probes = std::make_shared<IrradianceProbes>();
    probes->count = header.count;
    probes->depthSize = header.depthSize;
    probes->probes.reserve(count);
    for (size_t i = 0; i < count; ++i) probes->probes.push_back(readProbe(reader, header.largest));
    probes->depths.reserve(depths);
    for (size_t i = 0; i < depths; ++i) {
        const float mean = static_cast<float>(reader.take<uint16_t>()) / kDepthSteps * header.farthest;
        const float root = static_cast<float>(reader.take<uint16_t>()) / kDepthSteps * header.farthest;
        probes->depths.emplace_back(mean, root * root);
    }
    header.desc.probes = probes;
    return std::move(header.desc);
}

} // namespace filament_core

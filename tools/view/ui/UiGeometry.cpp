// SPDX-License-Identifier: Apache-2.0
#include "tools/view/ui/UiGeometry.h"

#include "tools/view/ui/ImGuiVersions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>

namespace filament_core::view {
namespace {

constexpr size_t kMostRuns = 65536;
constexpr float kMostPixels = 65535;

constexpr float kFarthestPixel = 1 << 20;
constexpr float kFarthestUv = 1 << 20;

/// False also for NaN.
bool isNear(float2 place, float most) { return std::abs(place.x) <= most && std::abs(place.y) <= most; }

template <class T>
std::span<const std::byte> bytesOf(std::vector<T> const& values) {
    return std::as_bytes(std::span(values));
}

template <class T>
bool sameBytes(std::vector<T> const& a, std::vector<T> const& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), bytesOf(a).size()) == 0);
}

/// The first whole pixel whose centre is at `edge` or beyond it.
float pixelEdge(float edge, float most) { return std::clamp(std::ceil(edge - 0.5f), 0.0f, most); }

} // namespace

std::vector<AttributeDesc> uiVertexAttributes() {
    return { { Attribute::Position, VertexFormat::Float3, offsetof(UiVertex, position) },
             { Attribute::Uv0, VertexFormat::Float2, offsetof(UiVertex, uv) },
             { Attribute::Color, VertexFormat::UByte4N, offsetof(UiVertex, color) },
             { Attribute::Custom0, VertexFormat::UShort4N, offsetof(UiVertex, clipPixels) } };
}

uint2 uiPixels(ImDrawData const& drawData) {
    const auto side = [](float points, float scale) {
        const float pixels = std::round(points * scale);
        return pixels >= 1 && pixels <= kMostPixels ? static_cast<uint32_t>(pixels) : 0; // NaN: 0
    };
    const uint2 size(side(drawData.DisplaySize.x, drawData.FramebufferScale.x),
                     side(drawData.DisplaySize.y, drawData.FramebufferScale.y));
    return size.x > 0 && size.y > 0 ? size : uint2(0);
}

void UiGeometry::build(ImDrawData const& drawData) {
    mVertices.clear();
    mIndices.clear();
    mRuns.clear();
    mSkipped = 0;
    const uint2 size = uiPixels(drawData);
    if (size.x == 0 || !drawData.Valid) return;
    mOrigin = { drawData.DisplayPos.x, drawData.DisplayPos.y };
    mScale = { drawData.FramebufferScale.x, drawData.FramebufferScale.y };
    mSize = float2(size);
    for (ImDrawList const* list : drawLists(drawData))
        if (list) add(*list);
}

void UiGeometry::add(ImDrawList const& list) {
    const auto count = static_cast<size_t>(list.VtxBuffer.Size);
    if (mStored.size() < count) mStored.resize(count);
    for (ImDrawCmd const& command : list.CmdBuffer)
        if (!command.UserCallback) add(list, command);
}

UiGeometry::Clip UiGeometry::clipOf(ImDrawCmd const& command) const {
    ImVec4 const& rectangle = command.ClipRect;
    const float2 least = (float2(rectangle.x, rectangle.y) - mOrigin) * mScale;
    const float2 most = (float2(rectangle.z, rectangle.w) - mOrigin) * mScale;
    if (std::isnan(least.x + least.y + most.x + most.y)) return {};
    return { { pixelEdge(least.x, mSize.x), pixelEdge(least.y, mSize.y), pixelEdge(most.x, mSize.x),
               pixelEdge(most.y, mSize.y) } };
}

void UiGeometry::add(ImDrawList const& list, ImDrawCmd const& command) {
    const Clip clip = clipOf(command);
    const auto available = static_cast<uint32_t>(list.IdxBuffer.Size);
    const uint32_t whole = command.ElemCount / 3 * 3;
    const uint32_t there = command.IdxOffset < available ? std::min(whole, (available - command.IdxOffset) / 3 * 3) : 0;
    mSkipped += (whole - there) / 3;
    if (clip.isEmpty()) return;
    if (++mCommand == 0) { // after 2^32 commands: all that is stored is old
        std::fill(mStored.begin(), mStored.end(), Stored{});
        mCommand = 1;
    }
    const size_t before = mIndices.size();
    for (uint32_t i = 0; i < there; i += 3) addTriangle(list, command, command.IdxOffset + i, clip);
    if (mIndices.size() > before) extendRun(command.GetTexID());
    if (mRuns.size() > kMostRuns) {
        mRuns.pop_back();
        mIndices.resize(before);
    }
}

void UiGeometry::addTriangle(ImDrawList const& list, ImDrawCmd const& command, uint32_t firstIndex, Clip const& clip) {
    uint32_t corners[3];
    float2 least(kFarthestPixel), most(-kFarthestPixel);
    for (uint32_t i = 0; i < 3; ++i) {
        const uint64_t corner = uint64_t{ command.VtxOffset } + list.IdxBuffer.Data[firstIndex + i];
        if (corner >= static_cast<uint64_t>(list.VtxBuffer.Size) || !isUsable(list.VtxBuffer.Data[corner])) {
            ++mSkipped;
            return;
        }
        corners[i] = static_cast<uint32_t>(corner);
        const float2 pixel = pixelOf(list.VtxBuffer.Data[corner]);
        least = glm::min(least, pixel);
        most = glm::max(most, pixel);
    }
    float4 const& seen = clip.pixels;
    if (least.x >= seen.z || least.y >= seen.w || most.x <= seen.x || most.y <= seen.y) return;
    for (const uint32_t corner : corners) mIndices.push_back(indexOf(list.VtxBuffer.Data[corner], corner, clip));
}

bool UiGeometry::isUsable(ImDrawVert const& vertex) const {
    return isNear(pixelOf(vertex), kFarthestPixel) && isNear({ vertex.uv.x, vertex.uv.y }, kFarthestUv);
}

float2 UiGeometry::pixelOf(ImDrawVert const& vertex) const {
    return (float2(vertex.pos.x, vertex.pos.y) - mOrigin) * mScale;
}

uint32_t UiGeometry::indexOf(ImDrawVert const& vertex, uint32_t index, Clip const& clip) {
    Stored& stored = mStored[index];
    if (stored.command == mCommand) return stored.index;
    stored = { mCommand, static_cast<uint32_t>(mVertices.size()) };
    const float2 place = pixelOf(vertex) / mSize * 2.0f - 1.0f;
    UiVertex made{ .position = { place.x, place.y, 0.5f }, .uv = { vertex.uv.x, vertex.uv.y } };
    for (int c = 0; c < 4; ++c) {
        made.color[c] = static_cast<uint8_t>(vertex.col >> (8 * c));
        made.clipPixels[c] = static_cast<uint16_t>(clip.pixels[c]);
    }
    mVertices.push_back(made);
    return stored.index;
}

void UiGeometry::extendRun(ImTextureID texture) {
    const auto end = static_cast<uint32_t>(mIndices.size());
    if (mRuns.empty() || mRuns.back().texture != texture) {
        const uint32_t begin = mRuns.empty() ? 0 : mRuns.back().firstIndex + mRuns.back().indexCount;
        mRuns.push_back({ .texture = texture, .firstIndex = begin });
    }
    mRuns.back().indexCount = end - mRuns.back().firstIndex;
}

bool operator==(UiGeometry const& a, UiGeometry const& b) {
    return a.mRuns == b.mRuns && sameBytes(a.mIndices, b.mIndices) && sameBytes(a.mVertices, b.mVertices);
}

} // namespace filament_core::view

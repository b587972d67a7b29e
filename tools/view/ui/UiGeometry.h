// SPDX-License-Identifier: Apache-2.0
/// UiGeometry: Dear ImGui's draw lists as one array of vertices, one of indices, and the runs of triangles that show
/// the same texture, in the order in which they are drawn.
///   In       any ImDrawData, also one that a bug made: triangles with indices beyond the lists, or with positions or
///            coordinates that are not finite or beyond 2^20, are left out, and so are those that lie outside of their
///            rectangle. Callbacks are not called.
///   Clipping each vertex carries the rectangle of its command, so that commands with different rectangles share a
///            draw. Rectangles are rounded to whole pixels: a pixel is inside if its centre is.
///   Memory   grows to the largest image, and is kept. A vertex is stored once for each command that uses it: at most
///            one for each index.
///   Thread   any; a plain value.   Cost: proportional to the indices.
///   Limits   65536 runs; images up to 65535 pixels a side. What goes beyond is not drawn.
#pragma once

#include <filament_core/Math.h>
#include <filament_core/Objects.h>

#include <imgui.h>

#include <cstdint>
#include <vector>

namespace filament_core::view {

/// As ui.mat reads it.
struct UiVertex {
    float3 position{ 0 };     ///< clip coordinates: (-1, -1) is the upper left corner
    float2 uv{ 0 };           ///< (0, 0): the upper left corner of the texture
    uint8_t color[4]{};       ///< red, green, blue, alpha
    uint16_t clipPixels[4]{}; ///< left, top, right, bottom
};
static_assert(sizeof(UiVertex) == 32, "vertices are compared by their bytes: no padding");

std::vector<AttributeDesc> uiVertexAttributes();

struct UiRun {
    ImTextureID texture{};
    uint32_t firstIndex = 0, indexCount = 0;
    friend bool operator==(UiRun const&, UiRun const&) = default;
};

/// The pixels of an image of this interface; 0 if its size is not a number, or nothing.
uint2 uiPixels(ImDrawData const& drawData);

class UiGeometry {
public:
    void build(ImDrawData const& drawData);

    std::vector<UiVertex> const& vertices() const { return mVertices; }
    std::vector<uint32_t> const& indices() const { return mIndices; }
    std::vector<UiRun> const& runs() const { return mRuns; }
    uint32_t skippedTriangles() const { return mSkipped; } ///< broken ones, not those outside of their rectangle

    friend bool operator==(UiGeometry const& a, UiGeometry const& b);

private:
    struct Clip {
        float4 pixels{ 0 }; ///< whole numbers
        bool isEmpty() const { return pixels.x >= pixels.z || pixels.y >= pixels.w; }
    };
    Clip clipOf(ImDrawCmd const& command) const;
    void add(ImDrawList const& list);
    void add(ImDrawList const& list, ImDrawCmd const& command);
    void addTriangle(ImDrawList const& list, ImDrawCmd const& command, uint32_t firstIndex, Clip const& clip);
    bool isUsable(ImDrawVert const& vertex) const;
    float2 pixelOf(ImDrawVert const& vertex) const;
    uint32_t indexOf(ImDrawVert const& vertex, uint32_t index, Clip const& clip);
    void extendRun(ImTextureID texture);

    /// Where a vertex of the list is in mVertices, if it was stored for the current command.
    struct Stored {
        uint32_t command = 0, index = 0;
    };

    std::vector<UiVertex> mVertices;
    std::vector<uint32_t> mIndices;
    std::vector<UiRun> mRuns;
    std::vector<Stored> mStored;
    uint32_t mCommand = 0; ///< counts commands since the object was made; 0 is none
    uint32_t mSkipped = 0;
    float2 mOrigin{ 0 }, mScale{ 1 }, mSize{ 1 }; ///< of the image: pixels = (position - origin) * scale
};

} // namespace filament_core::view

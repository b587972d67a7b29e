// SPDX-License-Identifier: Apache-2.0
/// StencilState: stencil test and stencil operations of a surface. A view has one
/// value of 8 bits for each sample, 0 in the beginning; they exist only in frames in which a visible surface has a
/// state.
///   Use      Engine::setStencil(). Portals, outlines, cut-outs of interfaces: docs/views.md.
///   Order    opaque objects that write values are drawn before everything else, those that only test them in the usual
///            order; transparent objects keep their order in either case.
///   Limits   the visible surfaces only: shadow maps, motion vectors, picking and the depth for effects (ambient
///            occlusion, reflections, depth of field) ignore it.
///   Thread   plain values.   Fails: never.
#pragma once

#include <cstdint>

namespace filament_core {

/// How (reference & readMask) compares to (value & readMask) where a surface is drawn.
enum class StencilTest : uint8_t { Never, Less, LessEqual, Equal, NotEqual, GreaterEqual, Greater, Always };

/// Operation on the bits of writeMask.
enum class StencilOperation : uint8_t {
    Keep,
    Zero,
    Replace,        ///< by the reference
    IncrementClamp, ///< up to 255
    DecrementClamp, ///< down to 0
    Invert,
    IncrementWrap, ///< 0 after 255
    DecrementWrap, ///< 255 after 0
};

/// For the faces of one side.
struct StencilFace {
    StencilTest test = StencilTest::Always;
    StencilOperation onFail = StencilOperation::Keep;      ///< the test fails
    StencilOperation onDepthFail = StencilOperation::Keep; ///< it passes, and something nearer is there
    StencilOperation onPass = StencilOperation::Keep;      ///< both pass
    uint8_t reference = 0;
    uint8_t readMask = 0xFF, writeMask = 0xFF;
    friend bool operator==(StencilFace const&, StencilFace const&) = default;

    bool writes() const {
        const bool changes = onFail != StencilOperation::Keep || onDepthFail != StencilOperation::Keep ||
                             onPass != StencilOperation::Keep;
        return changes && writeMask != 0;
    }
};

struct StencilState {
    StencilFace front{}, back{}; ///< culled faces do nothing
    friend bool operator==(StencilState const&, StencilState const&) = default;

    bool writes() const { return front.writes() || back.writes(); }
};

/// The same for both sides.
constexpr StencilState bothSides(StencilFace const& face) { return { face, face }; }

} // namespace filament_core

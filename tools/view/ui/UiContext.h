// SPDX-License-Identifier: Apache-2.0
/// UiContext: a context of Dear ImGui for one interface, set up as UiRenderer draws it: current from its beginning and
/// from each newFrame(), no file of settings, the style and the fonts of a display scale.
///   Scale    sizes and fonts are multiplied by it, and positions count pixels of the target (DisplayFramebufferScale
///            is 1): glyphs lie on whole pixels at every scale, 1.25 as well as 2. Scale mouse positions to pixels,
///            too.
///   Fonts    ImGui's own, so that images are the same on every machine; rasterised at the scale. A larger one is
///            made only when asked for: give it to UiRenderer::uploadFonts() after setScale().
///   Thread   one; ImGui has one current context.
#pragma once

#include <filament_core/Math.h>

#include <imgui.h>

#include <memory>

namespace filament_core::view {

inline constexpr float kLeastUiScale = 0.5f, kMostUiScale = 4;

class UiContext {
public:
    explicit UiContext(float scale = 1);

    /// Clamped to [kLeastUiScale, kMostUiScale]; NaN counts as 1. Between frames. True: style and fonts are new.
    bool setScale(float scale);
    float scale() const { return mScale; }
    ImGuiContext* get() const { return mContext.get(); } ///< for programs with several: ImGui::SetCurrentContext()
    ImFontAtlas& fonts() { return *ImGui::GetIO().Fonts; }

    /// Begins a frame of so many pixels.
    void newFrame(uint2 pixels, float seconds);

private:
    struct Destroy {
        void operator()(ImGuiContext* context) const { ImGui::DestroyContext(context); }
    };
    std::unique_ptr<ImGuiContext, Destroy> mContext;
    float mScale = 0;
};

} // namespace filament_core::view

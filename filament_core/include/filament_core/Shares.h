// SPDX-License-Identifier: Apache-2.0
/// Shares: how much of a picture each light and each effect gave. Terms whose sum has the bits of the picture, before
/// tone mapping. docs/shares.md.
///   How     the picture is drawn with the first term alone, then with the first two, and so on; the share of a term is
///           the difference that it made. Frames differ in amounts of light and in effects only: lists of lights,
///           shadow maps and exposure are those of the picture.
///   Sum     the last frame is the picture, so shares in doubles add up to its half floats exactly, effects that are
///           not additive included. Only for these the order of terms matters.
///   Thread  the app thread, which waits for the pixels. Not while a frame is drawn. Histories of other renderers are
///           not touched: each term has a renderer of its own.
///   Memory  8 B a pixel and term, and what a renderer takes.   Cost: a frame for each term. Other frames: none.
#pragma once

#include <filament_core/Renderer.h>

#include <span>
#include <string>
#include <vector>

namespace filament_core {

enum class ShareKind : uint8_t {
    Emission,    ///< what shines by itself: emissive and unlit surfaces, the sky, splats, the bodies of area lights
    Environment, ///< indirect light: of the environment, reflection probes and irradiance grids
    Lights,      ///< one or more lights
    Effect,      ///< what an effect changed
};
template <>
struct EnumNames<ShareKind> {
    static constexpr std::array<std::string_view, 4> values{ "emission", "environment", "lights", "effect" };
};

struct ShareTerm {
    ShareKind kind = ShareKind::Emission;
    std::string name;            ///< unique among the terms: "emission", "light2 lamp", "ambientOcclusion"
    std::vector<Light> lights{}; ///< of kind Lights
};

/// Lights that are one term.
struct LightGroup {
    std::string name;
    std::vector<Light> lights{};
};

/// Into which terms a picture is taken apart.
enum class ShareTerms : uint8_t {
    Lights,  ///< by light, each with its shadows and what additive effects make of it; a last term for other effects
    Effects, ///< all light without effects, then what each effect of the view adds, in the order of the pipeline
    All,     ///< by light, without effects, and then by effect
};
template <>
struct EnumNames<ShareTerms> {
    static constexpr std::array<std::string_view, 3> values{ "lights", "effects", "all" };
};

struct ShareOptions {
    static constexpr uint32_t kMostFrames = 1024;
    ShareTerms terms = ShareTerms::Lights;
    std::span<const LightGroup> groups{}; ///< in this order; a light that is in none is a term of its own, after them
    /// The picture is the last of so many frames of the view, [1, 1024]: for effects that gather over frames.
    uint32_t frames = 1;
};

struct Shares {
    uint2 size{ 0 };
    std::vector<ShareTerm> terms;
    std::vector<Image> sums; ///< by term: of RGBA16F, the picture with this term and those before it

    /// Red, green, blue and alpha of a term, pre-exposed linear light. `pixel`: from the left and from the top. Not
    /// finite where the picture, or a sum before it, is not.
    double4 share(size_t term, uint2 pixel) const;
    /// share() of all pixels, rounded to RGBA32F.
    Image image(size_t term) const;
};

/// View::viewport is ignored, and so is Resolution::dynamic: the scale stays. View::debugView and aov must be None. A
/// handle of a group that is no light of the scene ends the process.
/// Fails as Renderer::waitPixels() and Engine::create() do.
Result<Shares> renderShares(Engine& engine, Scene const& scene, View const& view, ShareOptions const& options = {});

/// As an OpenEXR file of full floats: a layer for each term, named as the term with `_` for what is no letter or digit,
/// and "rounding": what floats cannot hold of the shares, if anything. All layers together add up to the picture's
/// bits. Fails as saveExr() of layers does.
Result<void> saveExr(std::filesystem::path const& path, Shares const& shares);

} // namespace filament_core

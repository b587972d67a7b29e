// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Effects.h>

#include "filament_core/values/OptionRows.h"

#include <span>
#include <vector>

namespace filament_core {
namespace {

using Rows = std::vector<Option>;

constexpr std::string_view kMeters = "metres", kPerMeter = "1/m", kStops = "stops", kSpeed = "stops a second",
                           kColor = "R,G,B";
constexpr std::array<std::string_view, 4> kSampleCounts{ "3", "7", "16", "32" };
constexpr std::array<std::string_view, 3> kSliceCounts{ "1", "2", "3" }, kReflectionSteps{ "16", "48", "128" },
        kContactSteps{ "8", "16", "32" };

Rows ambientOcclusionRows() {
    using E = AmbientOcclusion;
    return { option("ambientOcclusion", &E::enabled, "Occludes indirect light by what the depth buffer shows."),
             option("ambientOcclusion.method", &E::method, "Samples of a spiral, or horizons of slices."),
             option("ambientOcclusion.resolution", &E::resolution, "Pixels for which occlusion is computed."),
             option("ambientOcclusion.samples", &E::samples, { 3, 32, {}, kSampleCounts }, "Samples of `sao`."),
             option("ambientOcclusion.slices", &E::slices, { 1, 3, {}, kSliceCounts }, "Slices of `gtao`."),
             option("ambientOcclusion.blur", &E::blur, "Smooths noise along surfaces."),
             option("ambientOcclusion.bentNormals", &E::bentNormals,
                    "Takes diffuse light from the mean unoccluded direction."),
             option("ambientOcclusion.radiusMeters", &E::radiusMeters, { 1e-4, 1e4, kMeters },
                    "Distance at which surfaces still occlude."),
             option("ambientOcclusion.intensity", &E::intensity, { 0, 8 }, "Exponent of the visibility.") };
}

Rows screenSpaceReflectionsRows() {
    using E = ScreenSpaceReflections;
    return { option("screenSpaceReflections", &E::enabled, "Reflects the rendered scene."),
             option("screenSpaceReflections.steps", &E::steps, { 8, 255, {}, kReflectionSteps },
                    "Cells of the depth pyramid that a ray visits at most."),
             option("screenSpaceReflections.distanceMeters", &E::distanceMeters, { 1e-3, 1e5, kMeters },
                    "Length of a reflected ray."),
             option("screenSpaceReflections.thicknessMeters", &E::thicknessMeters, { 1e-4, 1e4, kMeters },
                    "Assumed thickness of visible surfaces.") };
}

Rows fogRows() {
    using E = Fog;
    return { option("fog", &E::enabled, "Exponential height fog."),
             option("fog.density", &E::density, { 0, 1e4, kPerMeter }, "Density at `fog.heightMeters`."),
             option("fog.startMeters", &E::startMeters, { 0, 1e6, kMeters }, "No fog nearer to the camera."),
             option("fog.cutOffMeters", &E::cutOffMeters, { 0, 1e9, kMeters }, "No fog farther away; 0: no limit."),
             option("fog.heightMeters", &E::heightMeters, { -1e6, 1e6, kMeters },
                    "World height at which `fog.density` holds."),
             option("fog.heightFalloff", &E::heightFalloff, { 0, 1e3, kPerMeter },
                    "How fast the density falls with the height."),
             option("fog.maximumOpacity", &E::maximumOpacity, { 0, 1 }, "Opacity that fog never exceeds."),
             option("fog.color", &E::color, { 0, 1e3, kColor }, "Scattered light, relative to the environment."),
             option("fog.colorFromEnvironment", &E::colorFromEnvironment,
                    "Multiplies the colour by the blurred environment."),
             option("fog.inScatteringStartMeters", &E::inScatteringStartMeters, { 0, 1e6, kMeters },
                    "Distance at which fog begins to scatter the sun's light."),
             option("fog.volumetric", &E::volumetric, "Lamps and the shadowed sun light the fog."),
             option("fog.albedo", &E::albedo, { 0, 1, kColor }, "Share of the light that fog scatters."),
             option("fog.anisotropy", &E::anisotropy, { -0.95, 0.95 },
                    "Mean cosine of scattering; 0: alike in all directions."),
             option("fog.volumetricMeters", &E::volumetricMeters, { 0.1, 1e5, kMeters },
                    "Distance at which the cells of volumetric fog end."),
             option("fog.volumetricPixels", &E::volumetricPixels, { 8, 64, "pixels" }, "Width of a column of cells."),
             option("fog.volumetricSlices", &E::volumetricSlices, { 8, 128 }, "Cells of a column."),
             option("fog.volumetricFrames", &E::volumetricFrames, { 1, 64, "frames" },
                    "In which all cells are lit, a part in each."),
             option("fog.attenuatesLight", &E::attenuatesLight, "Weakens light on its way to volumetric fog."),
             option("fog.noiseAmplitude", &E::noiseAmplitude, { 0, 1 },
                    "Share by which the density of volumetric fog varies."),
             option("fog.noiseMeters", &E::noiseMeters, { 0.01, 1e4, kMeters }, "Size of the largest swirls."),
             option("fog.noiseOctaves", &E::noiseOctaves, { 1, 4 }, "Sizes of swirls, each half of the one before."),
             option("fog.noiseWind", &E::noiseWind, { -1e3, 1e3, "X,Y,Z" }, "Moves the swirls, in metres a second."),
             option("fog.inScatteringSize", &E::inScatteringSize, { 0, 1e3 },
                    "Exponent of the cosine of the sun's glow; 0: none.") };
}

Rows contactShadowsRows() {
    using E = ContactShadows;
    return { option("contactShadows.steps", &E::steps, { 4, 64, {}, kContactSteps }, "Samples of a ray."),
             option("contactShadows.distanceMeters", &E::distanceMeters, { 1e-4, 1e4, kMeters },
                    "Length of the ray towards the light."),
             option("contactShadows.thicknessMeters", &E::thicknessMeters, { 1e-5, 1e4, kMeters },
                    "Assumed thickness of visible surfaces.") };
}

Rows bloomRows() {
    using E = Bloom;
    return { option("bloom", &E::enabled, "Scatters light around bright areas."),
             option("bloom.resolution", &E::resolution, "Size of the first level."),
             option("bloom.strength", &E::strength, { 0, 1 }, "Share of the light that is scattered."),
             option("bloom.radius", &E::radius, { 1e-3, 1 }, "Radius of the widest lobe, of the image height."),
             option("bloom.threshold", &E::threshold, { 0, 1e4 }, "Scatters only light above this value; 1 is white."),
             option("bloom.dirtStrength", &E::dirtStrength, { 0, 1 },
                    "Share of the scattered light that dirt on the lens modulates.") };
}

Rows depthOfFieldRows() {
    using E = DepthOfField;
    return { option("depthOfField", &E::enabled, "Blurs what the lens does not focus."),
             option("depthOfField.focusMeters", &E::focusMeters, { 0, 1e9, kMeters },
                    "Distance along the view that is sharp."),
             option("depthOfField.blurScale", &E::blurScale, { 0, 100 }, "Factor of the aperture's blur."),
             option("depthOfField.maxRadius", &E::maxRadius, { 0, 0.1 }, "Largest radius, of the image height."),
             option("depthOfField.blades", &E::blades, { 0, 16 }, "Blades of the aperture; less than 3: round.") };
}

Rows motionBlurRows() {
    using E = MotionBlur;
    return { option("motionBlur", &E::enabled, "Blurs what moves while the shutter is open."),
             option("motionBlur.shutterDegrees", &E::shutterDegrees, { 0, 360, "degrees" },
                    "Part of a frame during which the shutter is open, of 360."),
             option("motionBlur.maxRadius", &E::maxRadius, { 0, 0.1 },
                    "Half of the longest blur, of the image height.") };
}

Rows autoExposureRows() {
    using E = AutoExposure;
    return { option("autoExposure", &E::enabled, "Exposes the mean luminance as middle grey."),
             option("autoExposure.lowPercentile", &E::lowPercentile, { 0, 1 }, "Darker pixels do not count."),
             option("autoExposure.highPercentile", &E::highPercentile, { 0, 1 }, "Brighter pixels do not count."),
             option("autoExposure.compensation", &E::compensation, { -16, 16, kStops }, "Added to the exposure."),
             option("autoExposure.minStops", &E::minStops, { -16, 16, kStops }, "Least correction."),
             option("autoExposure.maxStops", &E::maxStops, { -16, 16, kStops }, "Largest correction."),
             option("autoExposure.speedUp", &E::speedUp, { 0, 1e3, kSpeed }, "Speed towards brighter images."),
             option("autoExposure.speedDown", &E::speedDown, { 0, 1e3, kSpeed }, "Speed towards darker images.") };
}

Rows colorGradingRows() {
    using E = ColorGrading;
    return { option("colorGrading", &E::enabled, "Colour grading before the tone mapper."),
             option("colorGrading.nightAdaptation", &E::nightAdaptation, { 0, 1 }, "Vision by rods in the dark."),
             option("colorGrading.exposure", &E::exposure, { -16, 16, kStops }, "Exposure."),
             option("colorGrading.temperature", &E::temperature, { -1, 1 }, "White balance from cooler to warmer."),
             option("colorGrading.tint", &E::tint, { -1, 1 }, "White balance from green to magenta."),
             option("colorGrading.mixRed", &E::mixRed, { -2, 2, kColor }, "Red output of the channel mixer."),
             option("colorGrading.mixGreen", &E::mixGreen, { -2, 2, kColor }, "Green output of the channel mixer."),
             option("colorGrading.mixBlue", &E::mixBlue, { -2, 2, kColor }, "Blue output of the channel mixer."),
             option("colorGrading.shadows", &E::shadows, { 0, 4, kColor }, "Factor of shadows."),
             option("colorGrading.midtones", &E::midtones, { 0, 4, kColor }, "Factor of midtones."),
             option("colorGrading.highlights", &E::highlights, { 0, 4, kColor }, "Factor of highlights."),
             option("colorGrading.tonalRanges", &E::tonalRanges, { 0, 100, "A,B,C,D" },
                    "Luminances where shadows fade out (A to B) and highlights fade in (C to D)."),
             option("colorGrading.slope", &E::slope, { 0, 4, kColor }, "Slope of the ASC colour decision list."),
             option("colorGrading.offset", &E::offset, { -1, 1, kColor }, "Offset of the ASC colour decision list."),
             option("colorGrading.power", &E::power, { 0.1, 10, kColor }, "Power of the ASC colour decision list."),
             option("colorGrading.contrast", &E::contrast, { 0, 2 }, "Contrast about middle grey."),
             option("colorGrading.saturation", &E::saturation, { 0, 3 }, "Saturation of all colours."),
             option("colorGrading.vibrance", &E::vibrance, { 0, 3 }, "Saturation of pale colours."),
             option("colorGrading.shadowGamma", &E::shadowGamma, { 0.1, 10, kColor },
                    "Gamma of the curve up to `colorGrading.midPoint`."),
             option("colorGrading.midPoint", &E::midPoint, { 1e-3, 100, kColor },
                    "Where the two parts of the curve meet."),
             option("colorGrading.highlightScale", &E::highlightScale, { 0, 10, kColor },
                    "Slope of the curve beyond `colorGrading.midPoint`."),
             option("colorGrading.gamutMapping", &E::gamutMapping,
                    "Reduces the chroma of colours outside of Rec. 709 instead of clipping components.") };
}

Rows vignetteRows() {
    using E = Vignette;
    return { option("vignette", &E::enabled, "Darkens the corners."),
             option("vignette.midPoint", &E::midPoint, { 0, 1 }, "Distance from the centre at which it begins."),
             option("vignette.roundness", &E::roundness, { 0, 1 }, "Rectangle, ellipse (0.5) or circle."),
             option("vignette.feather", &E::feather, { 0.05, 1 }, "Softness of the edge."),
             option("vignette.color", &E::color, { 0, 1, kColor }, "Factor of the corners.") };
}

Rows grainRows() {
    using E = Grain;
    return { option("grain", &E::enabled, "Noise of photographic film."),
             option("grain.strength", &E::strength, { 0, 1 }, "Standard deviation in the midtones."),
             option("grain.size", &E::size, { 1, 8, "pixels" }, "Size of a grain.") };
}

Rows chromaticAberrationRows() {
    using E = ChromaticAberration;
    return { option("chromaticAberration", &E::enabled, "Coloured fringes of a lens."),
             option("chromaticAberration.strength", &E::strength, { 0, 0.1 },
                    "Distance of red and blue in the corners, of the image height.") };
}

Rows resolutionRows() {
    using E = Resolution;
    return { option("resolution.upscaling", &E::upscaling, "Filter that enlarges the image after the tone mapper."),
             option("resolution.scale", &E::scale, { 0.5, 1, "X,Y" }, "Share of the view's size that is drawn."),
             option("resolution.dynamic", &E::dynamic, "Chooses the share by the time that frames take."),
             option("resolution.targetMilliseconds", &E::targetMilliseconds, { 0.1, 1e3, "milliseconds" },
                    "Time that a frame may take."),
             option("resolution.leastScale", &E::leastScale, { 0.5, 1 }, "The smallest share."),
             option("resolution.headroom", &E::headroom, { 0, 0.5 },
                    "Share of the target time that stays free when the image grows."),
             option("resolution.history", &E::history, { 1, 32, "frames" },
                    "Frames that must agree before the share changes."),
             option("resolution.uniform", &E::uniform, "The same share both ways; off: the width first.") };
}

Rows sharpeningRows() {
    using E = Sharpening;
    return { option("sharpening", &E::enabled, "Raises the contrast between neighbours."),
             option("sharpening.strength", &E::strength, { 0, 1 }, "Strength.") };
}

Rows lensFlareRows() {
    using E = LensFlare;
    return { option("lensFlare", &E::enabled, "Ghosts and a halo of bright areas."),
             option("lensFlare.threshold", &E::threshold, { 0, 1e4 }, "Only light above this value; 1 is white."),
             option("lensFlare.ghostStrength", &E::ghostStrength, { 0, 1 }, "Share of the light in all ghosts."),
             option("lensFlare.ghostCount", &E::ghostCount, { 0, 8 }, "Number of ghosts."),
             option("lensFlare.ghostSpacing", &E::ghostSpacing, { 0.05, 2 },
                    "Distance between ghosts, of the light's distance from the centre."),
             option("lensFlare.ghostRadius", &E::ghostRadius, { 0.005, 0.25 }, "Mean radius, of the image height."),
             option("lensFlare.haloStrength", &E::haloStrength, { 0, 1 }, "Share of the light in the halo."),
             option("lensFlare.haloRadius", &E::haloRadius, { 0.05, 1 }, "Radius of the halo, of the image height."),
             option("lensFlare.haloThickness", &E::haloThickness, { 0, 1 }, "Width of the ring, of its radius."),
             option("lensFlare.dispersion", &E::dispersion, { 0, 1 }, "From white to the colours of a spectrum.") };
}

Rows guardBandRows() {
    using E = GuardBand;
    return { option("guardBand", &E::enabled, "Draws pixels around the image for screen-space effects."),
             option("guardBand.width", &E::width, { 0, 0.5 }, "Width on each side, of the image height.") };
}

} // namespace

template <>
std::span<const Option> optionsOf<Effects>() {
    static const Rows kOptions = [] {
        Rows all;
        append(all, &Effects::ambientOcclusion, ambientOcclusionRows());
        append(all, &Effects::screenSpaceReflections, screenSpaceReflectionsRows());
        append(all, &Effects::fog, fogRows());
        append(all, &Effects::contactShadows, contactShadowsRows());
        append(all, &Effects::bloom, bloomRows());
        append(all, &Effects::lensFlare, lensFlareRows());
        append(all, &Effects::depthOfField, depthOfFieldRows());
        append(all, &Effects::motionBlur, motionBlurRows());
        append(all, &Effects::autoExposure, autoExposureRows());
        append(all, &Effects::colorGrading, colorGradingRows());
        append(all, &Effects::vignette, vignetteRows());
        append(all, &Effects::grain, grainRows());
        append(all, &Effects::chromaticAberration, chromaticAberrationRows());
        append(all, &Effects::resolution, resolutionRows());
        append(all, &Effects::sharpening, sharpeningRows());
        append(all, &Effects::guardBand, guardBandRows());
        return all;
    }();
    return kOptions;
}

} // namespace filament_core

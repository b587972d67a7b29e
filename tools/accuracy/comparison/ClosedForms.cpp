// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/comparison/ClosedForms.h"

#include "tools/accuracy/TracedPicture.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace filament_core::accuracy {
namespace {

using reference::BsdfModel;
using tools::SceneSpec;

constexpr double kAlbedo = 0.6, kEmission = 0.25; // as in the scene files
constexpr double kRounding = 1e-5;                // relative: colours and normals are floats in files

double factorOf(SceneSpec const& scene) { return static_cast<double>(scene.exposure.factor()); }

double skyOf(SceneSpec const& scene) {
    return static_cast<double>(scene.environmentSettings.illuminance.value) * factorOf(scene);
}

double sunOf(SceneSpec const& scene) {
    SunLight const& sun = std::get<SunLight>(scene.lights.front());
    const double cosine = -glm::normalize(double3(sun.directionWorld)).z; // with the quad's normal, +z
    return static_cast<double>(sun.illuminance.value) * factorOf(scene) * cosine;
}

struct Form {
    const char *scene, *name, *formula;
    BsdfModel bsdf;
    double (*expected)(SceneSpec const& scene);
};

/// Lambert's lobe alone, and the whole material.
constexpr BsdfModel kLambert{ .coupling = reference::CouplingTerm::Never, .lobes = reference::LobeChoice::Diffuse };

constexpr Form kForms[] = {
    { "closed-wall/sky", "Lambert's lobe under a uniform sky", "albedo * radiance", kLambert,
      [](SceneSpec const& scene) { return kAlbedo * skyOf(scene); } },
    { "closed-wall/sun", "Lambert's lobe under a sun", "albedo / pi * illuminance * cosine", kLambert,
      [](SceneSpec const& scene) { return kAlbedo / std::numbers::pi * sunOf(scene); } },
    { "closed-wall/metal", "a white metal of roughness 0.5 in a white furnace", "radiance", BsdfModel{}, skyOf },
    { "closed-room", "every bounce in a glowing room", "emission / (1 - albedo)", kLambert,
      [](SceneSpec const&) { return kEmission / (1 - kAlbedo); } },
};

Result<ClosedForm> check(Form const& form, SceneSpec const& scene, tools::SceneFolders const& folders,
                         uint32_t samplesPerPixel, jobs::JobSystem& jobs) {
    const Result<reference::ReferenceScene> traced = referenceSceneOf(scene, folders, jobs);
    if (!traced) return traced.error();
    const reference::ReferenceView view{ cameraOf(scene, {}), scene.view.size };
    const Result<reference::ReferenceImage> image =
            reference::render(*traced, view, { .samplesPerPixel = samplesPerPixel, .bsdf = form.bsdf }, jobs);
    if (!image) return image.error();
    ClosedForm result{ .name = form.name, .formula = form.formula, .expected = form.expected(scene) };
    const auto count = static_cast<double>(image->color.size());
    double squares = 0;
    for (size_t i = 0; i < image->color.size(); ++i) {
        result.mean += static_cast<double>(image->color[i].x) / count;
        squares += std::pow(static_cast<double>(image->standardError[i].x), 2);
    }
    result.standardError = std::sqrt(squares) / count; // pixels are independent
    return result;
}

} // namespace

double ClosedForm::deviations() const {
    const double off = std::abs(mean - expected);
    return off <= kRounding * expected ? 0 : off / std::max(standardError, kRounding * expected);
}

bool ClosedForm::agrees() const { return deviations() <= 4; }

Result<std::vector<ClosedForm>> checkClosedForms(SceneLibrary const& scenes, tools::SceneFolders const& folders,
                                                 uint32_t samplesPerPixel, jobs::JobSystem& jobs) {
    std::vector<ClosedForm> results;
    for (Form const& form : kForms) {
        const Result<SceneSpec const*> scene = scenes.find(form.scene);
        if (!scene) return scene.error();
        Result<ClosedForm> result = check(form, **scene, folders, samplesPerPixel, jobs);
        if (!result) return result.error();
        results.push_back(std::move(*result));
    }
    return results;
}

} // namespace filament_core::accuracy

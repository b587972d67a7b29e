// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/TracedPicture.h"

#include "tools/reference/LoadScene.h"

#include <filament_core/Options.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace filament_core::view {
namespace {

/// What a traced scene is made of: all but the view.
bool hasSameScene(Document const& a, Document const& b) {
    return a.model == b.model && a.environment == b.environment && a.lights == b.lights;
}

reference::Options optionsOf(Document const& document) {
    reference::Options options;
    options.model = document.model.file;
    options.variant = document.model.variant;
    options.fit = document.model.fit;
    options.modelOptions = document.model.options;
    options.environment = document.environment.file;
    if (document.environment.file.empty()) options.environment = "none";
    options.environmentOptions = document.environment.options;
    options.iblIntensity = document.environment.settings.illuminance;
    options.skybox = document.environment.settings.skybox;
    return options;
}

struct AddLight {
    reference::ReferenceScene& scene;
    void operator()(SunLight const& light) const { scene.suns.push_back(light); }
    void operator()(PointLight const& light) const { scene.points.push_back(light); }
    void operator()(SpotLight const& light) const { scene.spots.push_back(light); }
    void operator()(RectLight const& light) const { scene.rects.push_back(light); }
    void operator()(DiscLight const& light) const { scene.discs.push_back(light); }
    void operator()(TubeLight const& light) const { scene.tubes.push_back(light); }
};

Result<reference::ReferenceScene> load(Document const& document, jobs::JobSystem& jobs) {
    std::vector<std::string> warnings;
    Result<reference::ReferenceScene> scene = reference::loadScene(optionsOf(document), jobs, warnings);
    if (!scene) return scene;
    if (scene->environment) scene->environment->rotationRadians = document.environment.settings.rotationRadians;
    for (DocumentLight const& each : document.lights)
        if (each.isOn) std::visit(AddLight{ *scene }, each.light);
    return scene;
}

/// Effects that the traced picture has, too: fog is traced, occlusion and reflections stand in for traced light, and a
/// guard band only widens what they see.
constexpr std::string_view kTracedEffects[] = { "fog", "ambientOcclusion", "screenSpaceReflections", "guardBand" };

/// Effects of the lens, the film and the eye: all others.
bool hasImageEffects(Effects const& effects) {
    return std::ranges::any_of(filament_core::optionsOf<Effects>(), [&](Option const& option) {
        const bool isSwitch = option.kind == OptionKind::Switch && option.name.find('.') == option.name.npos;
        return isSwitch && std::ranges::count(kTracedEffects, option.name) == 0 &&
               optionValue(option, &effects) == "on";
    });
}

bool hasProfile(DocumentLight const& light) { return light.isOn && !light.profileFile.empty(); }

} // namespace

std::string untracedParts(Document const& document) {
    std::vector<const char*> parts;
    if (!document.nodes.empty()) parts.push_back("edits of nodes");
    if (!document.materials.empty()) parts.push_back("edits of materials");
    if (!document.textures.empty()) parts.push_back("textures that were changed");
    if (!document.modelLights.empty()) parts.push_back("edits of the file's lights");
    if (!document.morphs.empty()) parts.push_back("morph weights");
    if (document.model.options.allLevels) parts.push_back("other levels of detail than the finest");
    if (document.playback.animation) parts.push_back("animations");
    if (std::ranges::any_of(document.lights, hasProfile)) parts.push_back("profiles of lights");
    if (hasImageEffects(document.view.effects)) parts.push_back("effects such as bloom");
    if (!document.look.empty()) parts.push_back("the look");
    if (document.view.debugView != DebugView::None) parts.push_back("debug views");
    return parts.empty() ? std::string{} : fmt::format("the path tracer does not see {}", fmt::join(parts, ", "));
}

void TracedPicture::follow(Document const& document, uint64_t number) {
    if (number != mNumber) restart(document, number);
    take();
    noteFailure(mReference.status());
}

void TracedPicture::restart(Document const& document, uint64_t number) {
    const bool isNewScene = !mDocument || !hasSameScene(document, *mDocument);
    mDocument = document;
    mNumber = number;
    mPicture.reset();
    if (isNewScene) mReference.setScene([document](jobs::JobSystem& jobs) { return load(document, jobs); });
    mView = mReference.setView({ .camera = document.view.camera,
                                 .size = document.view.size,
                                 .clearColor = document.view.clearColor,
                                 .fog = document.view.effects.fog,
                                 .timeSeconds = document.view.timeSeconds },
                               { .samplesPerPixel = mSamples });
    const std::string untraced = untracedParts(document);
    if (!untraced.empty() && untraced != mLastUntraced) mMessages.push_back(untraced);
    mLastUntraced = untraced;
}

void TracedPicture::take() {
    std::optional<TracedView> traced = mReference.takePicture();
    if (!traced || traced->view != mView) return;
    const uint32_t version = mPicture ? mPicture->version + 1 : 1;
    mPicture = NumberedPicture{ displayPicture(traced->image, mDocument->view.display), mNumber, version,
                                traced->isFinished };
}

void TracedPicture::noteFailure(TracingStatus const& status) {
    if (status.state != TracingStatus::State::Failed || status.error == mLastFailure) return;
    mLastFailure = status.error;
    mMessages.push_back(status.error);
}

std::string TracedPicture::name() const {
    const TracingStatus status = mReference.status();
    switch (status.state) {
    case TracingStatus::State::Loading:
        return "path tracer: loading";
    case TracingStatus::State::Failed:
        return "path tracer: failed";
    default:
        return fmt::format("path tracer: {} of {} samples, error {:.2f} %", status.samplesDone, status.samplesTotal,
                           status.relativeError * 100);
    }
}

} // namespace filament_core::view

// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/LightWork.h"

#include <fmt/format.h>

#include <algorithm>

namespace filament_core::view {
namespace {

/// "probe-3.ktx2": the first that is not there yet. A file is written once, so that undo finds the earlier one.
std::filesystem::path freshCapture(std::filesystem::path const& out) {
    for (uint32_t i = 1;; ++i) {
        std::filesystem::path file = out / fmt::format("probe-{}.ktx2", i);
        std::error_code ignored;
        if (!std::filesystem::exists(file, ignored)) return file;
    }
}

} // namespace

void LightWork::startCapture(size_t probe, Document const& document, EngineOptions const& options,
                             std::filesystem::path const& out) {
    if (mShot || probe >= document.probes.size()) return;
    mShotName = document.probes[probe].name;
    mShotFile = freshCapture(out);
    mShot.emplace([shot = ProbeShot{ document, probe, options, mShotFile }] { return captureToFile(shot); });
}

void LightWork::startBake(Panels const& panels, Document const& document, Stage& stage,
                          std::filesystem::path const& out) {
    BakeRequest request{ .document = document,
                         .usesModelEnvironment = stage.hasModelEnvironment(),
                         .settings = panels.state.bake,
                         .box = stage.bounds(),
                         .out = out,
                         .program = bakeProgram() };
    if (std::optional<size_t> const& chosen = panels.state.selectedProbe; chosen && *chosen < document.probes.size()) {
        DocumentProbe const& probe = document.probes[*chosen]; // the grid fills its box
        request.box = { probe.centerWorld - double3(probe.halfExtentMeters),
                        probe.centerWorld + double3(probe.halfExtentMeters) };
    }
    if (const Result<void> started = mBake.start(request); !started) mMessages.push_back(started.error().message);
}

void LightWork::follow(Panels& panels, Document const& document, Stage& stage, EngineOptions const& options,
                       std::filesystem::path const& out) {
    PanelRequests& requests = panels.requests;
    if (const std::optional<size_t> probe = std::exchange(requests.capturesProbe, std::nullopt))
        startCapture(*probe, document, options, out);
    if (std::exchange(requests.cancelsBake, false)) mBake.cancel();
    if (std::exchange(requests.startsBake, false)) startBake(panels, document, stage, out);
}

void LightWork::takeShot(Document& document) {
    const std::optional<Result<float>> intensity = takeFinished(mShot);
    if (!intensity) return;
    if (!*intensity) return mMessages.push_back(intensity->error().message);
    const auto probe = std::ranges::find(document.probes, mShotName, &DocumentProbe::name);
    if (probe == document.probes.end()) return; // it was removed, or has another name now
    probe->file = mShotFile;
    probe->intensity = **intensity;
    mMessages.push_back(fmt::format("{}: captured to {}", mShotName, mShotFile.string()));
}

void LightWork::takeBake(Document& document, Result<BakeResult> const& baked) {
    if (!baked) return mMessages.push_back(baked.error().message);
    mMessages.push_back(fmt::format("baked {}", baked->file.string()));
    if (baked->kind == BakeKind::Lightmap) {
        document.model.file = baked->file;
        return;
    }
    if (std::ranges::find(document.grids, baked->file, &DocumentGrid::file) == document.grids.end())
        document.grids.push_back({ .file = baked->file });
}

bool LightWork::poll(Panels& panels, Document& document) {
    takeShot(document);
    if (const auto baked = mBake.poll()) takeBake(document, *baked);
    const bool isOther = panels.inputs.bake != mBake.progress() || panels.inputs.isCapturing != mShot.has_value();
    panels.inputs.bake = mBake.progress();
    panels.inputs.isCapturing = mShot.has_value();
    return isOther || !mMessages.empty();
}

} // namespace filament_core::view

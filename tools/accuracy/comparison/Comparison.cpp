// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/comparison/Comparison.h"

#include "base/Suggest.h"
#include "toolkit/json/JsonFile.h"
#include "toolkit/pictures/Flip.h"
#include "tools/accuracy/References.h"
#include "tools/accuracy/TracedPicture.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace filament_core::accuracy {
namespace {

using reference::ReferenceImage;
using tools::Json;
using tools::JsonReader;
using tools::SceneSpec;

constexpr uint32_t kClosedFormSamples = 1024;

/// One row while it is computed.
class RowMaker {
public:
    RowMaker(ComparisonRow const& row, SceneSpec const& scene, Studio& studio, ComparisonOptions const& options,
             jobs::JobSystem& jobs)
            : mScene(scene), mStudio(studio), mOptions(options), mJobs(jobs) {
        mResult.row = row;
        mResult.size = options.size;
    }

    Result<RowResult> make(std::function<void(std::string_view rung, double done)> const& progress) {
        if (const Result<void> opened = open(); !opened) return opened.error();
        for (size_t i = 0; i < mRungs.size(); ++i) {
            progress(mRungs[i].title.empty() ? "the path tracer" : mRungs[i].title,
                     static_cast<double>(i) / static_cast<double>(mRungs.size() + 1));
            Result<Picture> picture = mRungs[i].kind == RungKind::Engine ? drawn(mRungs[i]) : traced(mRungs[i]);
            if (!picture) return picture.error();
            mResult.pictures.push_back(std::move(*picture));
        }
        measure();
        if (const Result<void> done = addAlternatives(); !done) return done.error();
        if (const Result<void> done = measureBits(); !done) return done.error();
        return std::move(mResult);
    }

private:
    Result<void> open() {
        LadderScene has{ .hasEnvironment = !mScene.environment.empty() };
        Result<reference::ReferenceScene> scene = referenceSceneOf(mScene, mOptions.folders, mJobs, &has.material);
        if (!scene) return scene.error();
        has.hasLights = !scene->suns.empty() || !scene->points.empty() || !scene->spots.empty();
        mRungs = ladder(has);
        if (const Result<void> known = checkStep(); !known) return known.error();
        Result<reference::TracedScenePtr> prepared = reference::prepare(*scene, mJobs);
        if (!prepared) return prepared.error();
        mTraced = std::move(*prepared);
        return {};
    }

    Result<void> checkStep() const {
        if (mResult.row.step.empty()) return {};
        const std::vector<std::string_view> known = namesOf(mRungs);
        if (std::ranges::find(known, mResult.row.step) != known.end()) return {};
        return fail(ErrorCode::NotFound, "step: this scene's ladder has no '{}'{}", mResult.row.step,
                    suggestion(mResult.row.step, known));
    }

    Result<std::unique_ptr<Take>> take(Rung const& rung, bool linear) {
        const Result<Settings> settings = settingsFor(mScene, mResult.row.set, rung.set);
        if (!settings) return settings.error();
        return mStudio.take(mScene, *settings, mOptions.size * rung.supersampling, linear);
    }

    Result<Picture> drawn(Rung const& rung) {
        Result<std::unique_ptr<Take>> shot = take(rung, true);
        if (!shot) return shot.error();
        mView = { (*shot)->view().camera, mOptions.size, (*shot)->view().clearColor };
        Result<Picture> picture = (*shot)->shoot();
        if (!picture) return picture;
        return rung.supersampling > 1 ? boxFiltered(*picture, rung.supersampling) : std::move(*picture);
    }

    Result<ReferenceImage> render(reference::ReferenceSettings settings) {
        settings.samplesPerPixel = std::min(mResult.row.samples, mOptions.mostSamples);
        Result<ReferenceImage> image = reference::render(*mTraced, mView, settings, mJobs);
        if (image) mResult.seconds += image->statistics.seconds;
        return image;
    }

    Result<Picture> traced(Rung const& rung) {
        Result<ReferenceImage> image = render({ .integrator = rung.integrator,
                                                .maxBounces = rung.maxBounces,
                                                .bsdf = rung.bsdf,
                                                .lightsCastShadows = true });
        if (!image) return image.error();
        // The first traced picture follows the engine's, so the noise of that step is entirely its own.
        if (mNoise.empty()) mNoise = image->standardError;
        mLastNoise = std::move(image->standardError);
        return Picture{ image->width, image->height, std::move(image->color) };
    }

    void measure() {
        std::vector<Picture> const& pictures = mResult.pictures;
        Picture const &engine = pictures.front(), &truth = pictures.back();
        mScale.emplace(truth, pictures[1]); // supersampled: half-covered edges are black in neither
        mResult.rms = rms(engine, truth, *mScale);
        mResult.bias = bias(engine, truth, *mScale);
        mResult.noise = noise(mNoise, *mScale);
        mResult.tracedNoise = noise(mLastNoise, *mScale);
        mResult.flip = tools::flip(tonemapped(truth), tonemapped(engine)).mean;
        const double whole = std::max(mResult.rms * mResult.rms, 1e-300);
        for (size_t i = 0; i + 1 < pictures.size(); ++i) {
            Rung const& rung = mRungs[i];
            const StepResult step{ .name = std::string(rung.name),
                                   .title = std::string(rung.title),
                                   .approximate = std::string(rung.approximate),
                                   .exact = std::string(rung.exact),
                                   .own = rms(pictures[i], pictures[i + 1], *mScale),
                                   .left = rms(pictures[i + 1], truth, *mScale),
                                   .share = product(pictures[i], pictures[i + 1], engine, truth, *mScale) / whole,
                                   .bias = bias(pictures[i], pictures[i + 1], *mScale) };
            if (rung.name == kUnexplained) {
                const double beyond = step.own * step.own - mResult.noise * mResult.noise;
                mResult.unexplained = std::sqrt(std::max(beyond, 0.0));
            }
            mResult.steps.push_back(step);
        }
    }

    Result<void> addAlternatives() {
        Picture const& truth = mResult.pictures.back();
        for (Alternative const& alternative : alternatives()) {
            Result<ReferenceImage> image = render({ .bsdf = alternative.bsdf });
            if (!image) return image.error();
            const Picture picture{ image->width, image->height, std::move(image->color) };
            mResult.alternatives.push_back({ .name = std::string(alternative.name),
                                             .title = std::string(alternative.title),
                                             .approximate = std::string(alternative.text),
                                             .own = rms(truth, picture, *mScale),
                                             .bias = bias(truth, picture, *mScale) });
        }
        return {};
    }

    /// The engine's 8-bit frame compared with its half floats through the same tone mapper, in display units.
    Result<void> measureBits() {
        Result<std::unique_ptr<Take>> shot = take(mRungs.front(), false);
        if (!shot) return shot.error();
        const Result<Picture> shown = (*shot)->shoot();
        if (!shown) return shown.error();
        mResult.eightBits = displayError(*shown, mResult.pictures.front(), (*shot)->view().display.toneMapper);
        return {};
    }

    SceneSpec const& mScene;
    Studio& mStudio;
    ComparisonOptions const& mOptions;
    jobs::JobSystem& mJobs;
    std::vector<Rung> mRungs;
    RowResult mResult;
    reference::TracedScenePtr mTraced;
    reference::ReferenceView mView;
    std::vector<float3> mNoise, mLastNoise;
    std::optional<DifferenceScale> mScale;
};

ComparisonRow readRow(JsonReader& reader) {
    ComparisonRow row;
    reader.read("name", row.name);
    reader.read("title", row.title);
    reader.read("scene", row.scene);
    reader.read("samples", row.samples, 2, 1u << 20);
    reader.read("unexplained", row.unexplained, 0, 1);
    reader.read("set", row.set);
    reader.read("step", row.step);
    reader.read("limit", row.limit, 0, 1);
    if (row.name.empty()) reader.complain("name", "a row has one");
    if (row.scene.empty()) reader.complain("scene", "a row names one");
    Settings scratch;
    if (const Result<void> done = change(scratch, row.set); !done) reader.complain("set", done.error().message);
    return row;
}

Result<void> keepChosen(std::vector<ComparisonRow>& rows, std::vector<std::string> const& chosen) {
    if (chosen.empty()) return {};
    const std::vector<std::string_view> known = namesOf(rows);
    for (std::string const& name : chosen) {
        if (std::ranges::find(known, name) == known.end())
            return fail(ErrorCode::NotFound, "--compare: there is no row '{}'{}", name, suggestion(name, known));
    }
    std::erase_if(rows, [&](ComparisonRow const& row) { return std::ranges::find(chosen, row.name) == chosen.end(); });
    return {};
}

} // namespace

Result<std::vector<ComparisonRow>> readComparisonRows(std::filesystem::path const& file) {
    const Result<Json> json = tools::readJson(file);
    if (!json) return json.error();
    if (!json->is_array() || json->empty()) {
        return fail(ErrorCode::InvalidArgument, "{}: must be a JSON list of rows", file.string());
    }
    std::vector<ComparisonRow> rows;
    for (Json const& element : *json) {
        JsonReader reader(element, fmt::format("{}: row {}", file.string(), rows.size()));
        rows.push_back(readRow(reader));
        if (const Result<void> done = reader.finish(); !done) return done.error();
    }
    return rows;
}

double RowResult::stepError() const {
    const auto step = std::ranges::find(steps, row.step, &StepResult::name);
    return step == steps.end() ? 0 : step->own;
}

Result<ComparisonResults> comparePictures(ComparisonOptions const& options, ComparisonProgress const& progress) {
    Result<std::vector<ComparisonRow>> rows = readComparisonRows(options.rows);
    if (!rows) return rows.error();
    if (const Result<void> kept = keepChosen(*rows, options.chosen); !kept) return kept.error();
    const Result<SceneLibrary> scenes = SceneLibrary::read(options.scenes);
    if (!scenes) return scenes.error();
    Result<std::unique_ptr<Studio>> studio = Studio::open(options.backend, options.folders);
    if (!studio) return studio.error();
    jobs::JobSystem jobs;
    ComparisonResults results;
    Result<std::vector<ClosedForm>> forms = checkClosedForms(*scenes, options.folders, kClosedFormSamples, jobs);
    if (!forms) return forms.error();
    results.closedForms = std::move(*forms);
    for (size_t i = 0; i < rows->size(); ++i) {
        ComparisonRow const& row = (*rows)[i];
        const Result<SceneSpec const*> scene = scenes->find(row.scene);
        if (!scene) return scene.error();
        if (const std::string missing = missingFile(**scene, options.folders.assets); !missing.empty()) {
            results.skipped.push_back({ row.name, missing });
            continue;
        }
        RowMaker maker(row, **scene, **studio, options, jobs);
        Result<RowResult> result = maker.make([&](std::string_view rung, double done) {
            if (progress)
                progress(fmt::format("{}: {}", row.name, rung),
                         (static_cast<double>(i) + done) / static_cast<double>(rows->size()));
        });
        if (!result) return fail(result.error().code, "{}: {}", row.name, result.error().message);
        results.rows.push_back(std::move(*result));
    }
    return results;
}

} // namespace filament_core::accuracy

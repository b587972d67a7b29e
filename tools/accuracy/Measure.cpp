// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/Measure.h"

#include "base/Suggest.h"
#include "tools/accuracy/References.h"
#include "tools/accuracy/Timings.h"

#include <algorithm>
#include <map>
#include <optional>

namespace filament_core::accuracy {
namespace {

using tools::SceneSpec;

class Measurement {
public:
    Measurement(std::vector<Effect> const& all, SceneLibrary const& scenes, MeasureOptions const& options,
                MeasureProgress const& progress)
            : mAll(all), mScenes(scenes), mOptions(options), mProgress(progress) {}

    Result<Results> run(std::vector<Effect> const& chosen) {
        if (const Result<void> opened = openStudios(); !opened) return opened.error();
        for (Effect const& effect : chosen) mStepsTotal += (2 + mStudios.size()) * effect.values.size();
        for (Effect const& effect : chosen) {
            if (const std::string missing = obstacleOf(effect); !missing.empty()) {
                mResults.skipped.push_back({ effect.name, missing });
                mStepsDone += (2 + mStudios.size()) * effect.values.size();
                continue;
            }
            Result<EffectResult> result = measureEffect(effect);
            if (!result) return fail(result.error().code, "effect {}: {}", effect.name, result.error().message);
            mResults.effects.push_back(std::move(*result));
            for (std::unique_ptr<Studio> const& studio : mStudios) studio->forgetUnusual();
        }
        mResults.frame = mOptions.frame;
        mResults.size = mOptions.size;
        mResults.rounds = mOptions.rounds;
        return std::move(mResults);
    }

private:
    Result<void> openStudios() {
        const auto bakes = std::make_shared<Bakes>(std::min(256u, 8 * mOptions.mostTraced));
        for (const Backend backend : mOptions.backends) {
            Result<std::unique_ptr<Studio>> studio = Studio::open(backend, mOptions.folders, bakes);
            if (!studio) return studio.error();
            DeviceDescription const& device = (*studio)->device();
            mResults.drivers[toString(backend)] = fmt::format("{}, {}", device.device, device.driver);
            mStudios.push_back(std::move(*studio));
        }
        return {};
    }

    /// Why an effect cannot be measured here; empty if it can.
    std::string obstacleOf(Effect const& effect) const {
        if (effect.reference.kind == ReferenceKind::OtherBackend && mStudios.size() < 2) return "two backends";
        for (std::string const& name : { effect.scene, effect.frame, effect.reference.scene }) {
            if (name.empty()) continue;
            const Result<SceneSpec const*> scene = mScenes.find(name);
            if (!scene) continue; // reported when the scene is drawn
            if (std::string missing = missingFile(**scene, mOptions.folders.assets); !missing.empty()) return missing;
        }
        return {};
    }

    void step(Effect const& effect, std::string_view what) {
        mProgress(fmt::format("{}: {}", effect.name, what), static_cast<double>(mStepsDone) / double(mStepsTotal));
        ++mStepsDone;
    }

    Result<EffectResult> measureEffect(Effect const& effect) {
        EffectResult result{ .effect = effect };
        result.command = fmt::format("build/release/bin/filament-accuracy --effect {}", effect.name);
        for (Value const& value : effect.values) result.values.push_back({ .value = value });
        if (const Result<void> done = ownErrors(result); !done) return done.error();
        if (const Result<void> done = frameErrors(result); !done) return done.error();
        for (size_t i = 0; i < mStudios.size(); ++i) {
            if (const Result<void> done = timings(result, i); !done) return done.error();
        }
        return result;
    }

    Result<void> keep(Picture const& picture, std::string const& effect, std::string name) const {
        if (mOptions.pictures.empty()) return {};
        std::ranges::replace(name, '/', '-');
        return savePng(mOptions.pictures / fmt::format("{} {}.png", effect, name), displayImage(picture));
    }

    Result<void> ownErrors(EffectResult& result) {
        Effect const& effect = result.effect;
        if (effect.reference.kind == ReferenceKind::Integral) return integralErrors(result);
        const Result<SceneSpec const*> scene = mScenes.find(effect.scene);
        if (!scene) return scene.error();
        const ReferenceStage stage{ *mStudios.front(), mScenes, mOptions.folders, mJobs };
        Reference reference = effect.reference;
        reference.samples = std::min(reference.samples, mOptions.mostTraced);
        const bool isOfEachValue = reference.kind == ReferenceKind::OtherBackend;
        Result<Truth> truth = isOfEachValue ? Truth{} : makeTruth(reference, **scene, effect.base, stage);
        if (!truth) return truth.error();
        result.referenceError = truth->standardError;
        for (ValueResult& value : result.values) {
            step(effect, "error of " + value.value.name);
            const auto draw = [&](Studio& studio) { return shootValue(studio, **scene, effect, value.value); };
            if (isOfEachValue) {
                Result<Picture> other = draw(*mStudios.back());
                if (!other) return other.error();
                truth->picture = std::move(*other);
            }
            const Result<Picture> picture = draw(*mStudios.front());
            if (!picture) return picture.error();
            value.own = compare(truth->picture, *picture, truth->edges);
            if (const Result<void> kept = keep(*picture, effect.name, value.value.name); !kept) return kept;
        }
        return keep(truth->picture, effect.name, "reference");
    }

    static Result<Picture> shootValue(Studio& studio, SceneSpec const& scene, Effect const& effect,
                                      Value const& value) {
        const Result<Settings> settings = settingsFor(scene, effect.base, value.set);
        return settings ? shoot(studio, scene, *settings, scene.view.size, scene.linear) : settings.error();
    }

    Result<void> integralErrors(EffectResult& result) {
        for (ValueResult& value : result.values) {
            step(result.effect, "error of " + value.value.name);
            Settings settings;
            if (const Result<void> done = change(settings, result.effect.base); !done) return done;
            if (const Result<void> done = change(settings, value.value.set); !done) return done;
            const Result<ErrorFigures> error = integralError(result.effect.reference.integral, settings, mJobs);
            if (!error) return error.error();
            value.own = *error;
        }
        return {};
    }

    /// The best value of every effect that is measured in this frame.
    std::vector<std::string> bestOfAll(std::string const& frame) const {
        std::vector<std::string> words;
        for (Effect const& effect : mAll) {
            if (effect.frame != frame) continue;
            std::vector<std::string> const& best = effect.values[effect.best].set;
            words.insert(words.end(), best.begin(), best.end());
        }
        return words;
    }

    /// An effect of the tone mapper is visible only in display-referred pictures, like those of its own scene.
    Result<void> frameErrors(EffectResult& result) {
        Effect const& effect = result.effect;
        const Result<SceneSpec const*> frame = mScenes.find(effect.frame);
        if (!frame) return frame.error();
        const Result<SceneSpec const*> own = effect.scene.empty() ? *frame : mScenes.find(effect.scene);
        if (!own) return own.error();
        const bool linear = result.linear = (*own)->linear || effect.scene.empty();
        const auto draw = [&](std::vector<std::string> const& base,
                              std::vector<std::string> const& words) -> Result<Picture> {
            Result<Settings> settings = settingsFor(**frame, base, words);
            if (!settings) return settings.error();
            return shoot(*mStudios.front(), **frame, *settings, mOptions.errorSize, linear);
        };
        const Result<Picture> best = draw(effect.base, effect.values[effect.best].set);
        if (!best) return best.error();
        std::optional<Picture>& bestOfEverything = mBestOfEverything[{ effect.frame, linear }];
        if (!bestOfEverything) {
            Result<Picture> drawn = draw({}, bestOfAll(effect.frame));
            if (!drawn) return drawn.error();
            bestOfEverything = std::move(*drawn);
        }
        for (ValueResult& value : result.values) {
            step(effect, "whole frame with " + value.value.name);
            const Result<Picture> picture = draw(effect.base, value.value.set);
            if (!picture) return picture.error();
            if (const Result<void> kept = keep(*picture, effect.name, "frame " + value.value.name); !kept) return kept;
            value.frame = compare(*best, *picture);
            value.total = compare(*bestOfEverything, *picture).rms;
        }
        return {};
    }

    Result<void> timings(EffectResult& result, size_t studio) {
        Effect const& effect = result.effect;
        const std::string backend = toString(mOptions.backends[studio]);
        const Result<SceneSpec const*> frame = mScenes.find(effect.frame);
        if (!frame) return frame.error();
        TimingJob job{ .studio = *mStudios[studio], .scene = **frame, .effect = effect };
        job.size = mOptions.size;
        job.rounds = effect.cost == Cost::Frame ? mOptions.rounds : mOptions.loadRounds;
        const size_t begin = mStepsDone;
        const Result<std::vector<Timing>> timed = timeInTurns(job, [&](double done) {
            mStepsDone = begin + static_cast<size_t>(done * double(effect.values.size()));
            mProgress(fmt::format("{}: time on {}", effect.name, backend),
                      static_cast<double>(mStepsDone) / double(mStepsTotal));
        });
        if (!timed) return timed.error();
        mStepsDone = begin + effect.values.size();
        for (size_t i = 0; i < timed->size(); ++i) result.values[i].timings[backend] = (*timed)[i];
        return {};
    }

    std::vector<Effect> const& mAll;
    SceneLibrary const& mScenes;
    MeasureOptions const& mOptions;
    MeasureProgress const& mProgress;
    jobs::JobSystem mJobs;
    std::vector<std::unique_ptr<Studio>> mStudios;
    std::map<std::pair<std::string, bool>, std::optional<Picture>> mBestOfEverything; // by scene, and whether linear
    Results mResults;
    size_t mStepsDone = 0, mStepsTotal = 0;
};

} // namespace

Result<Results> measure(std::vector<Effect> const& table, std::vector<std::string> const& chosen,
                        SceneLibrary const& scenes, MeasureOptions const& options, MeasureProgress const& progress) {
    std::vector<Effect> all = table, rows;
    for (Effect& effect : all)
        if (effect.frame == kWholeFrame) effect.frame = options.frame;
    for (std::string const& name : chosen) {
        const auto found = std::ranges::find(all, name, &Effect::name);
        if (found == all.end()) {
            return fail(ErrorCode::NotFound, "there is no effect '{}'{}", name, suggestion(name, namesOf(all)));
        }
        rows.push_back(*found);
    }
    return Measurement(all, scenes, options, progress).run(chosen.empty() ? all : rows);
}

} // namespace filament_core::accuracy

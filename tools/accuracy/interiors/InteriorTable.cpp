// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/interiors/InteriorTable.h"

#include "base/Suggest.h"
#include "toolkit/pictures/BlockErrors.h"
#include "tools/accuracy/Studio.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace filament_core::accuracy {
namespace {

constexpr uint32_t kWarmUp = 2;

double rootMeanSquare(std::vector<double> const& values) {
    double squares = 0;
    for (const double value : values) squares += value * value;
    return values.empty() ? 0 : std::sqrt(squares / static_cast<double>(values.size()));
}

class Measurement {
public:
    Measurement(InteriorOptions const& options, std::function<void(std::string const&, double)> const& progress)
            : mOptions(options), mProgress(progress) {}

    Result<InteriorResults> run(std::vector<InteriorCase> const& cases) {
        for (InteriorCase const& one : cases)
            mSteps += 2 + one.probes.size() + one.cameras.size() + kLightTechniques + mOptions.backends.size();
        for (const Backend backend : mOptions.backends) {
            Result<std::unique_ptr<Studio>> studio = Studio::open(backend, mOptions.folders);
            if (!studio) return studio.error();
            mStudios.push_back(std::move(*studio));
        }
        for (InteriorCase const& one : cases) {
            if (Result<void> done = measure(one); !done)
                return fail(done.error().code, "{}: {}", one.name, done.error().message);
        }
        return std::move(mResults);
    }

private:
    void step(std::string const& what) { mProgress(what, static_cast<double>(mDone++) / static_cast<double>(mSteps)); }

    Result<void> measure(InteriorCase const& one) {
        if (!one.room && !std::filesystem::exists(mOptions.folders.assets / one.asset)) {
            mResults.skipped.push_back({ one.name, one.asset });
            return {};
        }
        const std::function<void(std::string const&)> made = [&](std::string const& what) { step(what); };
        Result<InteriorFiles> files = makeFiles(one, mOptions.settings, mOptions.folders, mJobs, made);
        if (!files) return files.error();
        InteriorResult result{ .name = one.name, .title = one.title, .techniques = {} };
        if (auto done = drawAll(one, *files, result); !done) return done;
        for (size_t i = 0; mOptions.rounds > 0 && i < mStudios.size(); ++i) {
            step(fmt::format("{}: time on {}", one.name, toString(mOptions.backends[i])));
            if (auto done = timeAll(one, *files, i, result); !done) return done;
        }
        for (TracedInterior& traced : files->traced) result.traced.push_back(std::move(traced.picture));
        mResults.interiors.push_back(std::move(result));
        return {};
    }

    Result<void> drawAll(InteriorCase const& one, InteriorFiles const& files, InteriorResult& result) {
        for (size_t t = 0; t < kLightTechniques; ++t) {
            const auto technique = static_cast<LightTechnique>(t);
            step(fmt::format("{}: draw with {}", one.name, toString(technique)));
            for (size_t camera = 0; camera < one.cameras.size(); ++camera) {
                const SceneSpec spec = sceneOf(one, files, technique, camera, mOptions.settings.size);
                const auto take = mStudios.front()->take(spec, settingsOf(spec), mOptions.settings.size, true);
                if (!take) return take.error();
                Result<Picture> picture = (*take)->shoot();
                if (!picture) return picture.error();
                TracedInterior const& traced = files.traced[camera];
                const BlockErrors errors = blockErrors(*picture, traced.picture, traced.standardError);
                result.techniques[t].errors.push_back(errors.error);
                if (t == 0) result.noise.push_back(errors.noise);
                result.techniques[t].pictures.push_back(std::move(*picture));
            }
        }
        return {};
    }

    Result<void> timeAll(InteriorCase const& one, InteriorFiles const& files, size_t studio, InteriorResult& result) {
        std::array<std::vector<double>, kLightTechniques> samples;
        std::vector<std::array<std::unique_ptr<Take>, kLightTechniques>> takes(one.cameras.size());
        for (size_t camera = 0; camera < one.cameras.size(); ++camera) {
            for (size_t t = 0; t < kLightTechniques; ++t) {
                const SceneSpec spec = sceneOf(one, files, static_cast<LightTechnique>(t), camera, mOptions.timedSize);
                auto take = mStudios[studio]->take(spec, settingsOf(spec), mOptions.timedSize, false);
                if (!take) return take.error();
                takes[camera][t] = std::move(*take);
            }
        }
        for (uint32_t round = 0; round < mOptions.rounds + kWarmUp; ++round) {
            for (size_t i = 0; i < kLightTechniques; ++i) {
                const size_t t = (i + round) % kLightTechniques;
                const Result<double> milliseconds = takes[round % takes.size()][t]->time();
                if (!milliseconds) return milliseconds.error();
                if (round >= kWarmUp) samples[t].push_back(*milliseconds);
            }
        }
        const std::string backend = toString(mOptions.backends[studio]);
        for (size_t t = 0; t < kLightTechniques; ++t)
            result.techniques[t].ratios[backend] = estimateRatio(samples[t], samples[0]);
        return {};
    }

    InteriorOptions const& mOptions;
    std::function<void(std::string const&, double)> const& mProgress;
    jobs::JobSystem mJobs;
    std::vector<std::unique_ptr<Studio>> mStudios;
    InteriorResults mResults;
    size_t mDone = 0, mSteps = 0;
};

} // namespace

double InteriorResult::error(LightTechnique technique) const {
    return rootMeanSquare(techniques[static_cast<size_t>(technique)].errors);
}

double InteriorResult::meanNoise() const { return rootMeanSquare(noise); }

LightTechnique InteriorResult::best() const {
    size_t least = 0;
    for (size_t t = 1; t < kLightTechniques; ++t) {
        if (error(static_cast<LightTechnique>(t)) < error(static_cast<LightTechnique>(least))) least = t;
    }
    return static_cast<LightTechnique>(least);
}

Result<InteriorResults> measureInteriors(InteriorOptions const& options,
                                         std::function<void(std::string const&, double)> const& progress) {
    std::vector<InteriorCase> cases;
    std::vector<std::string> names;
    for (InteriorCase& one : interiorCases()) {
        names.push_back(one.name);
        if (options.chosen.empty() || std::ranges::find(options.chosen, one.name) != options.chosen.end())
            cases.push_back(std::move(one));
    }
    for (std::string const& name : options.chosen) {
        if (std::ranges::find(names, name) == names.end())
            return fail(ErrorCode::NotFound, "there is no interior '{}'{}", name,
                        suggestion(name, std::vector<std::string_view>(names.begin(), names.end())));
    }
    return Measurement(options, progress).run(cases);
}

} // namespace filament_core::accuracy

// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/Timings.h"

#include "tools/accuracy/References.h"

namespace filament_core::accuracy {
namespace {

constexpr uint32_t kWarmUp = 2;

/// One value, timed once.
using Turn = std::function<Result<double>()>;

struct Turns {
    std::vector<std::unique_ptr<Take>> takes; // drawn in turns
    std::vector<Settings> settings;
    std::vector<Turn> turns;
};

Result<Turns> prepareTurns(TimingJob const& job) {
    Turns all;
    all.settings.reserve(job.effect.values.size());
    for (Value const& value : job.effect.values) {
        Result<Settings> settings = settingsFor(job.scene, job.effect.base, value.set);
        if (!settings) return settings.error();
        Settings const& kept = all.settings.emplace_back(std::move(*settings));
        if (job.effect.cost == Cost::Environment) {
            all.turns.push_back([&job, &kept] { return job.studio.timeEnvironment(job.scene, kept); });
        } else if (job.effect.cost == Cost::Model) {
            all.turns.push_back([&job, &kept] { return job.studio.timeModel(job.scene, kept); });
        } else {
            Result<std::unique_ptr<Take>> take = job.studio.take(job.scene, kept, job.size, false);
            if (!take) return take.error();
            all.turns.push_back([drawn = take->get()] { return drawn->time(); });
            all.takes.push_back(std::move(*take));
        }
    }
    return all;
}

} // namespace

Result<std::vector<Timing>> timeInTurns(TimingJob const& job, std::function<void(double done)> const& progress) {
    const Result<Turns> prepared = prepareTurns(job);
    if (!prepared) return prepared.error();
    std::vector<Turn> const& turns = prepared->turns;
    const uint32_t warmUp = job.effect.cost == Cost::Frame ? kWarmUp : 0;
    std::vector<std::vector<double>> samples(turns.size());
    for (uint32_t round = 0; round < job.rounds + warmUp; ++round) {
        progress(static_cast<double>(round) / (job.rounds + warmUp));
        for (size_t i = 0; i < turns.size(); ++i) {
            const size_t turn = (i + round) % turns.size();
            const Result<double> milliseconds = turns[turn]();
            if (!milliseconds) return milliseconds.error();
            if (round >= warmUp) samples[turn].push_back(*milliseconds);
        }
    }
    std::vector<Timing> timings;
    for (std::vector<double> const& one : samples)
        timings.push_back({ estimate(one), estimateRatio(one, samples[job.effect.standard]) });
    return timings;
}

} // namespace filament_core::accuracy

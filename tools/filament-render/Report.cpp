// SPDX-License-Identifier: Apache-2.0
#include "tools/filament-render/Report.h"

#include "base/Statistics.h"
#include "toolkit/json/JsonFile.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace filament_core::tools {
namespace {

struct Spread {
    double min = 0, median = 0, max = 0;
};

Spread spreadOf(std::vector<double> values) {
    if (values.empty()) return {};
    const auto [min, max] = std::ranges::minmax(values);
    return { min, median(std::move(values)), max };
}

Json toJson(Spread spread) { return { { "min", spread.min }, { "median", spread.median }, { "max", spread.max } }; }

template <class Range, class Value>
std::vector<double> column(Range const& range, Value const& value) {
    std::vector<double> values;
    for (auto const& element : range) values.push_back(value(element));
    return values;
}

/// The timings without the first frame, which compiles and uploads.
std::span<const FrameTimings> steadyTimings(BackendRun const& run) {
    return std::span(run.timings).subspan(std::min<size_t>(1, run.timings.size()));
}

std::span<const FrameSample> steadySamples(BackendRun const& run) {
    return std::span(run.samples).subspan(std::min(kWarmUpSamples, run.samples.size()));
}

struct PassTime {
    std::string name;
    Spread gpu;
};

/// Every pass of the steady frames (of the first frame if there is no other), in the order of their first run. Passes
/// of the same name, such as the levels of bloom, count together.
std::vector<PassTime> passTimes(BackendRun const& run) {
    const std::span<const FrameTimings> frames = run.timings.size() > 1 ? steadyTimings(run) : std::span(run.timings);
    std::vector<std::string> order;
    std::map<std::string, std::vector<double>> values;
    for (FrameTimings const& frame : frames) {
        std::map<std::string, double> sums;
        for (PassTiming const& pass : frame.passes) {
            if (std::ranges::find(order, pass.name) == order.end()) order.push_back(pass.name);
            sums[pass.name] += pass.gpuMilliseconds;
        }
        for (auto const& [name, milliseconds] : sums) values[name].push_back(milliseconds);
    }
    std::vector<PassTime> times;
    for (std::string const& name : order) times.push_back({ name, spreadOf(values[name]) });
    return times;
}

Json toJson(FrameTimings const& frame) {
    Json passes = Json::array();
    for (PassTiming const& pass : frame.passes)
        passes.push_back({ { "name", pass.name }, { "gpuMs", pass.gpuMilliseconds } });
    return { { "frame", frame.frame },
             { "prepareMs", frame.prepareMilliseconds },
             { "recordMs", frame.recordMilliseconds },
             { "replayMs", frame.replayMilliseconds },
             { "gpuMs", frame.gpuMilliseconds },
             { "workerBusyMs", frame.workerBusyMilliseconds },
             { "beginSeconds", frame.beginSeconds },
             { "submitSeconds", frame.submitSeconds },
             { "replayBeginSeconds", frame.replayBeginSeconds },
             { "replayEndSeconds", frame.replayEndSeconds },
             { "passes", std::move(passes) } };
}

Json startJson(BackendRun const& run) {
    return { { "engineMs", run.start.engine },
             { "modelMs", run.start.model },
             { "environmentMs", run.start.environment },
             { "firstFrameMs", run.start.firstFrame },
             { "startToFirstFrameMs", run.start.startToFirstFrame } };
}

Json countsJson(BackendRun const& run) {
    FrameStatistics const& last = run.statistics;
    return { { "renderables", last.renderables },
             { "visible", last.visible },
             { "culled", last.culled },
             { "lights", last.lights },
             { "draws", last.draws },
             { "triangles", last.triangles },
             { "passesRun", last.passesRun },
             { "passesCulled", last.passesCulled },
             { "pipelinesCreated", run.atEnd.pipelinesCreated },
             { "pipelinesCreatedDuringDraws", run.atEnd.pipelinesCreatedInPasses },
             { "commands", run.atEnd.commands },
             { "deviceBytes", run.atEnd.deviceBytes } };
}

/// How much of the driver thread's replay of frame n overlapped with the app thread's work on frame n + 1.
double overlapMilliseconds(std::span<const FrameTimings> frames) {
    double seconds = 0;
    for (size_t i = 0; i + 1 < frames.size(); ++i) {
        const double begin = std::max(frames[i].replayBeginSeconds, frames[i + 1].beginSeconds);
        const double end = std::min(frames[i].replayEndSeconds, frames[i + 1].submitSeconds);
        seconds += std::max(0.0, end - begin);
    }
    return seconds * 1000;
}

Json steadyJson(BackendRun const& run) {
    const auto samples = steadySamples(run);
    const auto frames = steadyTimings(run);
    uint64_t allocations = 0;
    for (FrameSample const& sample : samples) allocations += sample.heapAllocations;
    const auto spread = [&](double FrameTimings::*member) {
        return toJson(spreadOf(column(frames, [&](FrameTimings const& frame) { return frame.*member; })));
    };
    return { { "frames", samples.size() },
             { "heapAllocations", allocations },
             { "pipelinesCreated", run.atEnd.pipelinesCreated - run.afterFirstFrame.pipelinesCreated },
             { "pipelinedFrameMs", run.pipelinedMilliseconds },
             { "appFrameMs", toJson(spreadOf(column(samples, [](FrameSample const& s) { return s.milliseconds; }))) },
             { "prepareMs", spread(&FrameTimings::prepareMilliseconds) },
             { "recordMs", spread(&FrameTimings::recordMilliseconds) },
             { "replayMs", spread(&FrameTimings::replayMilliseconds) },
             { "gpuMs", spread(&FrameTimings::gpuMilliseconds) },
             { "backPressureMs", static_cast<double>(run.atEnd.backPressureNanoseconds) * 1e-6 },
             { "submitToReplayedMedianMs", run.atEnd.latency.submitToReplayedMedian },
             { "submitToReplayedP99Ms", run.atEnd.latency.submitToReplayedP99 },
             { "appAndDriverOverlapMs", overlapMilliseconds(frames) } };
}

Json decisionsJson(BackendRun const& run) {
    Json decisions = Json::array();
    for (EffectDecision const& one : run.decisions) {
        decisions.push_back({ { "name", one.name },
                              { "state", toString(one.state) },
                              { "reason", one.reason },
                              { "gpuMs", one.gpuMilliseconds },
                              { "attachmentBytes", one.attachmentBytes } });
    }
    return decisions;
}

Json runJson(BackendRun const& run) {
    Json passes = Json::array(), frames = Json::array();
    for (PassTime const& pass : passTimes(run))
        passes.push_back({ { "name", pass.name }, { "gpuMs", toJson(pass.gpu) } });
    for (FrameTimings const& frame : run.timings) frames.push_back(toJson(frame));
    return { { "device", run.device.device },     { "driver", run.device.driver },
             { "start", startJson(run) },         { "counts", countsJson(run) },
             { "steady", steadyJson(run) },       { "passes", std::move(passes) },
             { "decisions", decisionsJson(run) }, { "frames", std::move(frames) },
             { "warnings", run.warnings },        { "errors", run.errors } };
}

/// Of the environment, as SunLights.
Json lightsJson(BackendRun const& run, Lux illuminance) {
    Json lights = Json::array();
    for (ExtractedLight const& light : run.lights.found()) {
        const SunLight sun = sunLightOf(light, { .illuminance = illuminance });
        lights.push_back({ { "direction", { sun.directionWorld.x, sun.directionWorld.y, sun.directionWorld.z } },
                           { "lux", sun.illuminance.value },
                           { "color", { sun.color.x, sun.color.y, sun.color.z } },
                           { "angularRadiusDegrees", sun.angularRadiusDegrees },
                           { "share", light.share } });
    }
    return lights;
}

/// The file that lit the images.
std::string environmentOf(ReportInput const& input) {
    const bool isOwn = std::ranges::any_of(input.runs, &BackendRun::usesModelEnvironment);
    return isOwn ? input.model.string() + " (EXT_lights_image_based)" : input.environment.string();
}

} // namespace

Result<void> writeReport(std::filesystem::path const& path, ReportInput const& input) {
    Json report{ { "model", input.model.string() },
                 { "environment", environmentOf(input) },
                 { "size", { input.options.view.size.x, input.options.view.size.y } },
                 { "frames", input.options.frames },
                 { "toneMapper", toString(input.options.view.display.toneMapper) } };
    if (!input.runs.empty() && input.runs.front().lights.search != SunSearch::Off)
        report["environmentLights"] = lightsJson(input.runs.front(), input.options.iblIntensity);
    for (BackendRun const& run : input.runs) report["backends"][fileStem(run.backend)] = runJson(run);
    if (input.comparison) {
        report["comparison"] = { { "pixels", input.comparison->pixels },
                                 { "identical", input.comparison->identical },
                                 { "maxDifference", input.comparison->maxDifference } };
    }
    report["errors"] = input.errors;
    return writeJson(path, report);
}

std::string timingText(BackendRun const& run) {
    StartTimes const& start = run.start;
    std::string text = fmt::format("{}: engine {:.1f} ms, model {:.1f}, environment {:.1f}, first frame {:.1f}; "
                                   "start to first frame {:.1f} ms\n",
                                   fileStem(run.backend), start.engine, start.model, start.environment,
                                   start.firstFrame, start.startToFirstFrame);
    auto out = std::back_inserter(text);
    if (!run.samples.empty()) {
        fmt::format_to(out, "{}: {} further frames, {:.2f} ms each while they overlap\n", fileStem(run.backend),
                       run.samples.size(), run.pipelinedMilliseconds);
    }
    for (PassTime const& pass : passTimes(run)) {
        fmt::format_to(out, "{}:   {:<24} {:8.3f} ms on the device\n", fileStem(run.backend), pass.name,
                       pass.gpu.median);
    }
    return text;
}

} // namespace filament_core::tools

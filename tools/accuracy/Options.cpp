// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/Options.h"

#include "toolkit/paths/Paths.h"
#include "toolkit/program/CommandLine.h"

namespace filament_core::accuracy {
namespace {

using tools::invalidOption;

struct Words {
    std::string effects = tools::sourceDir() / "tools/accuracy/effects.json";
    std::string scenes = tools::sourceDir() / "tools/accuracy/scenes";
    std::string assets = tools::assetDir();
    std::string out = "accuracy", page, pictures, frame, size, rounds, plots, shard, rooms;
    std::vector<std::string> backends, include, compare, interiors, merge;
    bool quick = false;
};

void declare(tools::CommandLine& app, Words& words, Options& options) {
    app.option("--compare", words.compare,
               "instead: the engine's pictures against the path tracer's, all rows or these; writes a fragment of the "
               "report into --out")
            .anyWords()
            .typeName("[NAME...]");
    app.option("--effect", options.effect, "only these rows").typeName("NAME...");
    app.option("--interiors", words.interiors,
               "instead: rooms lit by an environment, probes, grids and lightmaps against the path tracer, all or "
               "these; "
               "bakes into --out/work, which a second run uses again")
            .anyWords()
            .typeName("[NAME...]");
    app.option("--rooms", words.rooms,
               "instead: write the generated rooms, a Cornell box and a gallery, as models with a sky")
            .typeName("DIR");
    app.flag("--list", options.list, "print the rows and their values");
    app.option("--effects", words.effects, "the table of effects").typeName("FILE");
    app.option("--scenes", words.scenes, "folder of scene files").typeName("DIR");
    app.option("--assets", words.assets, "where \"asset:\" paths of scenes begin").typeName("DIR");
    app.option("-o,--out", words.out, "folder of results.json, results.csv and the plots").typeName("DIR");
    app.option("--page", words.page,
               "the report, its pictures in a folder of its name; default: accuracy.html in --out")
            .typeName("FILE");
    app.option("--include", words.include, "HTML fragments with further sections of the report").typeName("FILE...");
    app.option("--frame", words.frame, "scene for whole frames; default: the showcase").typeName("SCENE");
    app.option("--backend", words.backends, "vulkan gles; errors are measured on the first").typeName("NAME...");
    app.option("--rounds", words.rounds, "rounds in which every value is timed, 1 to 1000; default 15").typeName("N");
    app.option("--size", words.size, "size of the timed frames; default 960x540").typeName("WxH");
    app.option("--plots", words.plots, "draw them").typeName("on|off");
    app.option("--pictures", words.pictures, "also keep every picture whose error is measured").typeName("DIR");
    app.option("--shard", words.shard, "every N-th row beginning with row I, and no page; or auto, from the scheduler")
            .typeName("I/N");
    app.option("--merge", words.merge, "do not measure: merge the results of shards").typeName("DIR...");
    app.flag("--quick", words.quick, "small frames, three rounds: a quick test, not for quoting");
}

Result<void> convertBackends(std::vector<std::string> const& words, std::vector<Backend>& backends) {
    if (words.empty()) return {};
    backends.clear();
    for (std::string const& word : words) {
        if (word == "vulkan")
            backends.push_back(Backend::Vulkan);
        else if (word == "gles")
            backends.push_back(Backend::Gles);
        else
            return invalidOption("--backend", word, "vulkan, gles or both");
    }
    return {};
}

Result<void> convertSize(std::string const& word, uint2& size) {
    if (word.empty()) return {};
    const size_t x = word.find('x');
    const auto width = tools::wholeNumber(word.substr(0, x), 1, 8192);
    const auto height = x == std::string::npos ? std::nullopt : tools::wholeNumber(word.substr(x + 1), 1, 8192);
    if (!width || !height) return invalidOption("--size", word, "WIDTHxHEIGHT, each from 1 to 8192");
    size = { *width, *height };
    return {};
}

/// `isAsked`: the option was given, with or without names.
void convertComparison(Words const& words, bool isAsked, Options& options) {
    if (!isAsked) return;
    const std::filesystem::path folder = tools::sourceDir() / "tools/accuracy/comparison";
    ComparisonOptions comparison{ .rows = folder / "rows.json",
                                  .scenes = folder / "scenes",
                                  .folders = options.measure.folders,
                                  .chosen = words.compare,
                                  .backend = options.measure.backends.front() };
    std::erase(comparison.chosen, std::string());
    if (words.quick) {
        comparison.size = { 80, 45 };
        comparison.mostSamples = 16;
    }
    options.comparison = std::move(comparison);
}

/// `isAsked`: as above.
void convertInteriors(Words const& words, bool isAsked, Options& options) {
    if (!isAsked) return;
    InteriorOptions interiors{ .chosen = words.interiors,
                               .backends = options.measure.backends,
                               .timedSize = options.measure.size,
                               .rounds = options.measure.rounds,
                               .folders = options.measure.folders };
    std::erase(interiors.chosen, std::string());
    if (words.quick) interiors.settings = { .size = { 80, 48 }, .mostSamples = 64, .coarseness = 2 };
    options.interiors = std::move(interiors);
}

Result<void> convertShard(Words const& words, bool isComparison, Options& options) {
    options.merge.assign(words.merge.begin(), words.merge.end());
    if (words.shard.empty() && words.merge.empty()) return {};
    if (isComparison)
        return fail(ErrorCode::InvalidArgument, "--shard and --merge divide the effects; --compare runs undivided");
    if (words.shard.empty()) return {};
    if (!words.merge.empty())
        return fail(ErrorCode::InvalidArgument, "--merge measures nothing; give --shard without it");
    const Result<tools::Shard> shard = tools::parseShard(words.shard);
    if (!shard) return shard.error();
    options.shard = *shard;
    return {};
}

Result<void> convert(Words const& words, Options& options) {
    MeasureOptions& measure = options.measure;
    if (words.quick) {
        measure.size = measure.errorSize = { 160, 90 };
        measure.frame = "sun-chart"; // one material, no environment
        measure.rounds = 3, measure.loadRounds = 1, measure.mostTraced = 16;
    }
    if (!words.frame.empty()) measure.frame = words.frame;
    options.effects = words.effects, options.scenes = words.scenes;
    options.rooms = words.rooms;
    options.out = words.out, options.page = words.page, measure.pictures = words.pictures;
    options.include.assign(words.include.begin(), words.include.end());
    measure.folders = { options.out / "work", words.assets };
    if (auto done = convertBackends(words.backends, measure.backends); !done) return done;
    if (auto done = convertSize(words.size, measure.size); !done) return done;
    if (auto done = tools::convertSwitch("--plots", words.plots, options.plots); !done) return done;
    if (words.rounds.empty()) return {};
    const auto rounds = tools::wholeNumber(words.rounds, 1, 1000);
    if (!rounds) return invalidOption("--rounds", words.rounds, "a whole number from 1 to 1000");
    measure.rounds = *rounds;
    return {};
}

} // namespace

Result<std::optional<Options>> parseOptions(int argc, const char* const* argv) {
    tools::CommandLine app("Measures what each approximation of the engine costs, in error and in time.",
                           "filament-accuracy");
    Words words;
    Options options;
    declare(app, words, options);
    const Result<bool> parsed = app.parse(argc, argv);
    if (!parsed) return parsed.error();
    if (!*parsed) return std::optional<Options>();
    if (const Result<void> done = convert(words, options); !done) return done.error();
    const bool isComparison = app.wasGiven("--compare");
    convertComparison(words, isComparison, options);
    convertInteriors(words, app.wasGiven("--interiors"), options);
    if (const Result<void> done = convertShard(words, isComparison, options); !done) return done.error();
    return std::optional(options);
}

} // namespace filament_core::accuracy

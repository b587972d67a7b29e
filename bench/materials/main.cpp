// SPDX-License-Identifier: Apache-2.0
// material_bench: the cost of each term of a material over a full screen, as a ratio to the standard model, on both
// APIs.
//   Method  one engine per API. Every round draws every material once on each, so that all see the same machine.
//           Processor time of the process, which includes the device of a CPU driver, minus that of a frame without the
//           object; medians of the ratios within rounds. --wall uses elapsed time instead, for other devices.
//   Status  0: measured, table on standard output; 1: the reason in one line.
#include "base/Statistics.h"
#include "toolkit/machine/Machine.h"
#include "toolkit/materials/MaterialStand.h"
#include "toolkit/materials/MaterialTerms.h"
#include "toolkit/paths/Paths.h"
#include "toolkit/program/CommandLine.h"
#include "toolkit/scenes/SceneAssets.h"

#include <filament_core/filament_core.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>

#include <time.h>

namespace filament_core::bench {
namespace {

namespace fs = std::filesystem;

struct Options {
    int rounds = 15, frames = 4, lamps = 0;
    uint2 size{ 1280, 720 };
    std::string json, plot;
    std::vector<std::string> only; ///< parts of names; empty: all
    bool wall = false;
};

/// The cost of a term according to the reference text, as a ratio to the standard model; empty if it names none.
const char* referenceOf(std::string const& term) {
    static constexpr std::pair<std::string_view, const char*> kSaid[] = {
        { "standard", "1" },
        { "normal map", "1.1" },
        { "clear coat", "2" },
        { "anisotropy", "1.2" },
        { "subsurface", "1.3" },
        { "refraction, solid", "2 to 3" },
        { "refraction, thin", "2 to 3" },
    };
    const auto said = std::ranges::find(kSaid, term, &std::pair<std::string_view, const char*>::first);
    return said != std::end(kSaid) ? said->second : "";
}

double secondsOf(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

/// One engine, and a scene for each material.
class Device {
public:
    static Result<std::unique_ptr<Device>> open(Backend backend, Options const& options, fs::path const& work) {
        Result<Engine> engine = Engine::create({ .backend = backend, .workers = 0, .cacheDirectory = work });
        if (!engine) return engine.error();
        std::unique_ptr<Device> device(new Device(std::move(*engine), options));
        const tools::SceneSpec studio{ .environment = "studio" };
        const Result<fs::path> file = tools::environmentFile(studio, { work, {} });
        if (!file) return file.error();
        Result<Environment> environment = loadEnvironment(device->mEngine, *file, { .faceSize = 64, .samples = 128 });
        if (!environment) return environment.error();
        device->mEnvironment.emplace(std::move(*environment));
        device->addScene(nullptr);
        return device;
    }

    /// Adds a scene and draws it once, so that everything is compiled.
    Result<void> add(tools::MaterialFile const& file) {
        Result<tools::MaterialStand> stand = tools::MaterialStand::make(mEngine, file);
        if (!stand) return stand.error();
        mStands.push_back(std::make_unique<tools::MaterialStand>(std::move(*stand)));
        addScene(mStands.back().get());
        return {};
    }

    /// Seconds per frame; scene 0 has no object.
    double measure(size_t scene) {
        const clockid_t clock = mOptions.wall ? CLOCK_MONOTONIC : CLOCK_PROCESS_CPUTIME_ID;
        mEngine.waitIdle();
        const double begin = secondsOf(clock);
        for (int i = 0; i < mOptions.frames; ++i) mRenderer.render(*mScenes[scene], mView, mTarget);
        mEngine.waitIdle();
        return (secondsOf(clock) - begin) / mOptions.frames;
    }

    Backend backend() const { return mEngine.device().backend; }
    std::string const& name() const { return mEngine.device().device; }

private:
    Device(Engine engine, Options const& options) : mOptions(options), mEngine(std::move(engine)), mRenderer(mEngine) {
        mView.camera = Camera::lookAt({ 0.3, 0.2, 1 }, { 0, 0, 0 }, { .verticalFovDegrees = 50 });
        mView.size = options.size;
        mTarget = mEngine.own(mEngine.create(SwapChainDesc{ .size = mView.size, .name = "material_bench" }));
    }

    void addScene(tools::MaterialStand const* stand) {
        mScenes.push_back(std::make_unique<Scene>(mEngine));
        Scene& scene = *mScenes.back();
        if (stand)
            stand->addTo(scene,
                         double4x4(double4(4, 0, 0, 0), double4(0, 4, 0, 0), double4(0, 0, 4, 0), double4(0, 0, 0, 1)));
        scene.setEnvironment(*mEnvironment, { .illuminance = Lux{ 10'000 }, .skybox = false });
        scene.add(SunLight{ .directionWorld = { -0.4f, -0.5f, -1 } });
        for (int i = 0; i < mOptions.lamps; ++i)
            scene.add(PointLight{ .positionWorld = { 0.5 * i - 1, 0.5, 1 }, .intensity = Candela{ 10'000 } });
        mRenderer.render(scene, mView, mTarget);
        mEngine.waitIdle();
    }

    Options const& mOptions;
    Engine mEngine;
    std::optional<Environment> mEnvironment;
    std::vector<std::unique_ptr<tools::MaterialStand>> mStands;
    std::vector<std::unique_ptr<Scene>> mScenes; // destroyed before the objects that they show
    Owned<SwapChain> mTarget;
    Renderer mRenderer;
    View mView;
};

struct Row {
    tools::MaterialTerm what;
    std::vector<double> seconds[2]; ///< by device, by round; without the frame
    double ratio[2]{}, low[2]{}, high[2]{};
};

using Devices = std::vector<std::unique_ptr<Device>>;

Result<Devices> openAll(Options const& options, fs::path const& work) {
    Devices devices;
    for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
        Result<std::unique_ptr<Device>> device = Device::open(backend, options, work);
        if (!device) return device.error();
        devices.push_back(std::move(*device));
    }
    return devices;
}

/// Always includes the first case, with which the others are compared.
bool isWanted(tools::MaterialTerm const& what, size_t index, Options const& options) {
    return index == 0 || options.only.empty() || std::ranges::any_of(options.only, [&](std::string const& part) {
               return what.name.find(part) != std::string::npos;
           });
}

Result<std::vector<Row>> addAll(Devices& devices, Options const& options) {
    std::vector<Row> rows;
    const std::vector<tools::MaterialTerm> cases = tools::materialTerms();
    for (size_t i = 0; i < cases.size(); ++i) {
        tools::MaterialTerm const& what = cases[i];
        if (!isWanted(what, i, options)) continue;
        const auto file = tools::readMaterialTerm(what);
        if (!file) return file.error();
        for (auto& device : devices) {
            if (Result<void> added = device->add(**file); !added) return added.error();
        }
        rows.push_back({ .what = what });
    }
    return rows;
}

void measureRound(Devices& devices, std::vector<Row>& rows) {
    for (size_t d = 0; d < devices.size(); ++d) {
        const double empty = devices[d]->measure(0);
        for (size_t i = 0; i < rows.size(); ++i) rows[i].seconds[d].push_back(devices[d]->measure(i + 1) - empty);
    }
}

void computeRatios(std::vector<Row>& rows, size_t devices) {
    for (Row& row : rows) {
        for (size_t d = 0; d < devices; ++d) {
            std::vector<double> ratios;
            for (size_t round = 0; round < row.seconds[d].size(); ++round)
                ratios.push_back(row.seconds[d][round] / rows[0].seconds[d][round]);
            row.ratio[d] = median(ratios);
            std::ranges::sort(ratios);
            row.low[d] = ratios[ratios.size() / 4];
            row.high[d] = ratios[ratios.size() * 3 / 4];
        }
    }
}

void printTable(std::vector<Row> const& rows) {
    std::printf(
            "| material | Vulkan ms | x standard | GLES ms | x standard | reference |\n|---|---|---|---|---|---|\n");
    for (Row const& row : rows) {
        std::printf("| %s | %.2f | %.2f | %.2f | %.2f | %s |\n", row.what.name.c_str(), median(row.seconds[0]) * 1e3,
                    row.ratio[0], median(row.seconds[1]) * 1e3, row.ratio[1], referenceOf(row.what.name));
    }
}

nlohmann::json toJson(std::vector<Row> const& rows, Devices const& devices, Options const& options) {
    nlohmann::json list = nlohmann::json::array();
    for (Row const& row : rows) {
        nlohmann::json one{ { "name", row.what.name }, { "reference", referenceOf(row.what.name) } };
        for (size_t d = 0; d < devices.size(); ++d) {
            one[toString(devices[d]->backend())] = { { "ms", median(row.seconds[d]) * 1e3 },
                                                     { "ratio", row.ratio[d] },
                                                     { "low", row.low[d] },
                                                     { "high", row.high[d] } };
        }
        list.push_back(std::move(one));
    }
    return { { "kind", "materials" },
             { "machine", tools::describeMachine() },
             { "commit", tools::builtCommit() },
             { "device", devices.front()->name() },
             { "size", { options.size.x, options.size.y } },
             { "rounds", options.rounds },
             { "rows", list } };
}

Result<void> write(Options const& options, nlohmann::json const& report) {
    const std::string path = options.json.empty() && !options.plot.empty() ? options.plot + ".json" : options.json;
    if (path.empty()) return {};
    std::ofstream file(path);
    file << report.dump(2) << '\n';
    file.close();
    if (!file) return fail(ErrorCode::Unreadable, "cannot write '{}'; does its folder exist?", path);
    if (options.plot.empty()) return {};
    const std::string command =
            fmt::format("{} {}/tools/plot/plot.py materials '{}' -o '{}'", tools::plotPython().string(),
                        tools::sourceDir().string(), path, options.plot);
    if (std::system(command.c_str()) != 0) return fail(ErrorCode::Internal, "'{}' failed", command);
    return {};
}

Result<void> run(Options const& options) {
    const fs::path work = fs::temp_directory_path() / "filament_material_bench";
    fs::create_directories(work);
    Result<Devices> devices = openAll(options, work);
    if (!devices) return devices.error();
    Result<std::vector<Row>> rows = addAll(*devices, options);
    if (!rows) return rows.error();
    for (int round = 0; round < options.rounds; ++round) measureRound(*devices, *rows);
    computeRatios(*rows, devices->size());
    printTable(*rows);
    return write(options, toJson(*rows, *devices, options));
}

} // namespace
} // namespace filament_core::bench

int main(int argc, char** argv) {
    using namespace filament_core;
    bench::Options options;
    std::string size = "1280x720";
    filament_core::tools::CommandLine app{
        "What each term of a material costs over a full screen, beside the standard model."
    };
    app.option("--rounds", options.rounds, "rounds; each draws every material once").inRange(1, 10'000);
    app.option("--frames", options.frames, "frames a measurement").inRange(1, 1000);
    app.option("--lamps", options.lamps, "point lights besides environment and sun").inRange(0, 64);
    app.option("--size", size, "WxH in pixels");
    app.option("--json", options.json, "also write the figures to this file");
    app.option("--plot", options.plot, "also draw them: .png, .svg or .pdf");
    app.option("--only", options.only, "cases whose names contain one of these");
    app.flag("--wall", options.wall, "elapsed time instead of processor time");
    if (const std::optional<int> status = app.exitStatus(argc, argv)) return *status;
    if (std::sscanf(size.c_str(), "%ux%u", &options.size.x, &options.size.y) != 2 || options.size.x == 0 ||
        options.size.y == 0 || options.size.x > 8192 || options.size.y > 8192) {
        std::fprintf(stderr, "material_bench: error: --size wants WxH up to 8192, got '%s'\n", size.c_str());
        return 1;
    }
    const Result<void> done = bench::run(options);
    if (!done) std::fprintf(stderr, "material_bench: error: %s\n", done.error().message.c_str());
    return done ? 0 : 1;
}

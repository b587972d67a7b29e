// SPDX-License-Identifier: Apache-2.0
// Rendering to arrays, and what frames needed.
#include "python/Bindings.h"
#include "python/SceneParts.h"

#include <filament_core/ExplainPixel.h>
#include <filament_core/RenderAovs.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>

namespace filament_core::python {
namespace {

constexpr int64_t kMaxFrames = 1'000'000;

/// A renderer and the images that it draws into.
struct Drawing {
    Renderer renderer;
    Owned<SwapChain> images{};
    uint2 size{ 0 };
    Format format = Format::RGBA8;
    bool isDrawing = false;
};
using DrawingObject = Held<Drawing>;

std::shared_ptr<DrawingObject> makeRenderer(EngineObject const& engine, bool passTimers) {
    const Owner::Call call(*engine.owner);
    return std::make_shared<DrawingObject>(engine.owner,
                                           Drawing{ Renderer(call.engine(), { .passTimers = passTimers }) });
}

void prepareImages(Engine& engine, Owner const& owner, Drawing& drawing, uint2 size, Format format) {
    const uint32_t most = owner.device().maxTextureSize;
    if (size.x > most || size.y > most)
        raiseInvalid("size: {} x {} pixels, but the device draws at most {} a side", size.x, size.y, most);
    if (drawing.images.get() && drawing.size == size && drawing.format == format) return;
    drawing.images = engine.own(engine.create(SwapChainDesc{ .size = size, .imageCount = 1, .format = format }));
    drawing.size = size;
    drawing.format = format;
}

/// Raises the errors of the device, KeyboardInterrupt, and what ends the work of daemon threads.
void checkFrame(Owner& owner) {
    Owner::checkExit();
    owner.raiseErrors();
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// A handler of a signal runs inside of render(): there the renderer is not its own.
class DrawingMark {
public:
    explicit DrawingMark(Drawing& drawing) : mDrawing(drawing) {
        if (drawing.isDrawing) raiseThreadError("the renderer is at work: draw once that call has returned");
        drawing.isDrawing = true;
    }
    ~DrawingMark() { mDrawing.isDrawing = false; }
    DrawingMark(DrawingMark const&) = delete;
    DrawingMark& operator=(DrawingMark const&) = delete;

private:
    Drawing& mDrawing;
};

/// `passes`: those of the view, which refers to them.
View viewOf(ViewObject const& view, Owner const& owner, std::vector<PostProcessPass>& passes) {
    View copy = view.view;
    if (view.dirt) {
        requireSame(owner, *view.dirt, "bloom_dirt");
        copy.effects.bloom.dirt = (*view.dirt)->get();
    }
    for (auto const& [instance, place] : view.passes) {
        requireSame(owner, *instance, "post_process");
        passes.push_back({ (*instance)->instance, place });
    }
    copy.postProcess = passes;
    return copy;
}

py::array render(DrawingObject const& self, SceneObject const& scene, ViewObject const& view, std::string const& output,
                 int64_t frames) {
    if (output != "display" && output != "light") raiseInvalid("output: '{}' is not display or light", output);
    if (frames < 1 || frames > kMaxFrames) raiseInvalid("frames: {} is not from 1 to {}", frames, kMaxFrames);
    Owner& owner = *self.owner();
    const Owner::Call call(owner);
    requireSame(owner, scene, "scene");
    std::vector<PostProcessPass> passes;
    const View settings = viewOf(view, owner, passes);
    Drawing& drawing = *self;
    const DrawingMark mark(drawing);
    const Scene& content = *scene;
    const Format format = output == "light" ? Format::RGBA16F : Format::RGBA8;
    prepareImages(call.engine(), owner, drawing, settings.size, format);
    if (!drawing.images.get()) checkFrame(owner);
    if (!drawing.images.get()) raise({ ErrorCode::OutOfMemory, "there is no memory for the picture" });
    for (int64_t frame = 0; frame < frames; ++frame) {
        released([&] { drawing.renderer.render(content, settings, drawing.images); });
        checkFrame(owner);
    }
    const PixelTicket ticket = drawing.renderer.readPixels(drawing.images);
    if (!ticket) raise({ ErrorCode::OutOfMemory, "there is no memory for the pixels" });
    Result<Image> image = released([&] { return drawing.renderer.waitPixels(ticket); });
    checkFrame(owner); // says more than the missing pixels do
    const Image pixels = valueOf(std::move(image));
    const size_t bytes = size_t{ pixels.width } * pixels.height * (format == Format::RGBA8 ? 4 : 8);
    if (pixels.format != format || pixels.pixels.size() != bytes)
        raise({ ErrorCode::DeviceLost, "the device gave no pixels" });
    return arrayOf(pixels);
}

/// Of light or of surfaces, in an image that the device can draw. `passes`: those of the view, which refers to them.
View plainViewOf(ViewObject const& view, Owner const& owner, std::vector<PostProcessPass>& passes) {
    View settings = viewOf(view, owner, passes);
    settings.debugView = DebugView::None;
    const uint32_t most = owner.device().maxTextureSize;
    if (settings.size.x > most || settings.size.y > most)
        raiseInvalid("size: {} x {} pixels, but the device draws at most {} a side", settings.size.x, settings.size.y,
                     most);
    return settings;
}

/// Colours of a mesh pass, textures for all of which there is memory.
struct MeshColors {
    std::vector<Owned<Texture>> textures;
    std::vector<Owned<RenderTarget>> single; ///< to read each
    Owned<RenderTarget> all;
};

MeshColors makeMeshColors(Owner& owner, Engine& engine, uint2 size, size_t count) {
    MeshColors colors;
    std::vector<Texture> others;
    for (size_t i = 0; i < count; ++i) {
        colors.textures.push_back(engine.own(engine.create(TextureDesc{
                .format = Format::RGBA32F, .width = size.x, .height = size.y, .renderable = true, .name = "meshes" })));
        checkFrame(owner);
        if (!colors.textures.back().get()) raise({ ErrorCode::OutOfMemory, "there is no memory for the colours" });
        colors.single.push_back(engine.own(engine.create(RenderTargetDesc{ .color = colors.textures.back() })));
        if (i > 0) others.push_back(colors.textures.back());
    }
    colors.all =
            engine.own(engine.create(RenderTargetDesc{ .color = colors.textures[0], .others = std::move(others) }));
    return colors;
}

py::list renderMeshes(DrawingObject const& self, SceneObject const& scene, ViewObject const& view,
                      InstanceObject const& material, int64_t outputs, bool keepsHoles,
                      std::array<float, 4> const& clear) {
    if (outputs < 1 || outputs > 4) raiseInvalid("outputs: {} is not from 1 to 4", outputs);
    Owner& owner = *self.owner();
    const Owner::Call call(owner);
    requireSame(owner, scene, "scene");
    requireSame(owner, material, "material");
    std::vector<PostProcessPass> passes;
    const View settings = plainViewOf(view, owner, passes);
    Drawing& drawing = *self;
    const DrawingMark mark(drawing);
    const Scene& content = *scene;
    const MeshColors colors = makeMeshColors(owner, call.engine(), settings.size, static_cast<size_t>(outputs));
    MeshPass pass{ .material = material->instance, .keepsHoles = keepsHoles };
    pass.clearColors.fill({ clear[0], clear[1], clear[2], clear[3] });
    released([&] { drawing.renderer.render(content, pass, colors.all, settings); });
    checkFrame(owner);
    py::list arrays;
    for (Owned<RenderTarget> const& single : colors.single) {
        const PixelTicket ticket = drawing.renderer.readPixels(single);
        if (!ticket) raise({ ErrorCode::OutOfMemory, "there is no memory for the pixels" });
        Result<Image> image = released([&] { return drawing.renderer.waitPixels(ticket); });
        checkFrame(owner);
        arrays.append(arrayOf(valueOf(std::move(image))));
    }
    return arrays;
}

std::vector<Aov> aovsOf(std::vector<std::string> const& names) {
    std::vector<Aov> aovs;
    for (std::string const& name : names) {
        const std::optional<Aov> aov = enumFromName<Aov>(name);
        if (!aov || aov == Aov::None) raiseInvalid("names: '{}' is not {}", name, listed(enumNames<Aov>().subspan(1)));
        aovs.push_back(*aov);
    }
    return aovs;
}

py::dict renderAovsOf(EngineObject const& engine, SceneObject const& scene, ViewObject const& view,
                      std::vector<std::string> const& names, std::shared_ptr<DrawingObject> const& kept) {
    Owner& owner = *engine.owner;
    const Owner::Call call(owner);
    requireSame(owner, scene, "scene");
    std::vector<PostProcessPass> passes;
    const View settings = plainViewOf(view, owner, passes);
    const std::vector<Aov> aovs = aovsOf(names);
    const Scene& content = *scene;
    if (kept) requireSame(owner, *kept, "renderer");
    std::optional<DrawingMark> mark;
    if (kept) mark.emplace(**kept);
    Result<std::vector<Image>> drawn = released([&] {
        return kept ? renderAovs((*kept)->renderer, content, settings, aovs)
                    : renderAovs(call.engine(), content, settings, aovs);
    });
    checkFrame(owner);
    const std::vector<Image> images = valueOf(std::move(drawn));
    py::dict arrays;
    for (size_t i = 0; i < images.size(); ++i) arrays[py::str(names[i])] = arrayOf(images[i]);
    return arrays;
}

using LightsByName = std::map<std::string, std::vector<std::shared_ptr<LightObject>>>;

std::vector<LightGroup> groupsOf(SceneObject const& scene, LightsByName const& named) {
    std::vector<LightGroup> groups;
    for (auto const& [name, lights] : named) {
        LightGroup group{ .name = name };
        for (std::shared_ptr<LightObject> const& light : lights) {
            if (!light) raiseInvalid("groups: '{}' has a light that is None", name);
            if (light->scene.get() != &scene) raiseInvalid("groups: '{}' has a light of another scene", name);
            group.lights.push_back(light->live());
        }
        groups.push_back(std::move(group));
    }
    return groups;
}

ShareOptions shareOptionsOf(std::string const& terms, int64_t frames) {
    const std::optional<ShareTerms> known = enumFromName<ShareTerms>(terms);
    if (!known) raiseInvalid("terms: '{}' is not {}", terms, listed(enumNames<ShareTerms>()));
    if (frames < 1 || frames > int64_t{ ShareOptions::kMostFrames })
        raiseInvalid("frames: {} is not from 1 to {}", frames, ShareOptions::kMostFrames);
    return { .terms = *known, .frames = static_cast<uint32_t>(frames) };
}

py::array arrayOfShare(Shares const& shares, size_t term) {
    const std::array<py::ssize_t, 3> shape{ static_cast<py::ssize_t>(shares.size.y),
                                            static_cast<py::ssize_t>(shares.size.x), 4 };
    py::array_t<double> array(shape);
    double* out = array.mutable_data();
    for (uint32_t y = 0; y < shares.size.y; ++y) {
        for (uint32_t x = 0; x < shares.size.x; ++x) {
            const double4 share = shares.share(term, { x, y });
            for (int channel = 0; channel < 4; ++channel) *out++ = share[channel];
        }
    }
    return array;
}

py::dict renderSharesOf(EngineObject const& engine, SceneObject const& scene, ViewObject const& view,
                        std::string const& terms, LightsByName const& groups, int64_t frames) {
    Owner& owner = *engine.owner;
    const Owner::Call call(owner);
    requireSame(owner, scene, "scene");
    std::vector<PostProcessPass> passes;
    const View settings = plainViewOf(view, owner, passes);
    const std::vector<LightGroup> grouped = groupsOf(scene, groups);
    ShareOptions options = shareOptionsOf(terms, frames);
    options.groups = grouped;
    const Scene& content = *scene;
    Result<Shares> drawn = released([&] { return renderShares(call.engine(), content, settings, options); });
    checkFrame(owner);
    const Shares shares = valueOf(std::move(drawn));
    py::dict arrays;
    for (size_t term = 0; term < shares.terms.size(); ++term) {
        const py::str name(shares.terms[term].name);
        if (arrays.contains(name)) raiseInvalid("groups: '{}' is the name of another term", shares.terms[term].name);
        arrays[name] = arrayOfShare(shares, term);
    }
    return arrays;
}

py::object explainPixelOf(EngineObject const& engine, SceneObject const& scene, ViewObject const& view, int64_t x,
                          int64_t y, std::string const& terms, int64_t frames) {
    Owner& owner = *engine.owner;
    const Owner::Call call(owner);
    requireSame(owner, scene, "scene");
    std::vector<PostProcessPass> passes;
    const View settings = plainViewOf(view, owner, passes);
    const ShareOptions options = shareOptionsOf(terms, frames);
    if (x < 0 || x >= int64_t{ settings.size.x } || y < 0 || y >= int64_t{ settings.size.y })
        raiseInvalid("pixel: {}, {} is not in a view of {} x {} pixels", x, y, settings.size.x, settings.size.y);
    const uint2 pixel(static_cast<uint32_t>(x), static_cast<uint32_t>(y));
    const Scene& content = *scene;
    Result<PixelExplanation> explained =
            released([&] { return explainPixel(call.engine(), content, settings, pixel, options); });
    checkFrame(owner);
    return py::module_::import("json").attr("loads")(toJson(valueOf(std::move(explained))));
}

py::list decisionsOf(DrawingObject const& self) {
    const Owner::Call call(*self.owner());
    py::list list;
    for (EffectDecision const& decision : self->renderer.decisions()) {
        py::dict dict;
        dict["name"] = decision.name;
        dict["state"] = toString(decision.state);
        dict["reason"] = decision.reason;
        dict["gpu_milliseconds"] = decision.gpuMilliseconds;
        dict["attachment_bytes"] = decision.attachmentBytes;
        list.append(dict);
    }
    return list;
}

py::dict statisticsOf(DrawingObject const& self) {
    const Owner::Call call(*self.owner());
    const FrameStatistics statistics = self->renderer.statistics();
    return dictOfCounts({ { "frame", statistics.frame },
                          { "renderables", statistics.renderables },
                          { "visible", statistics.visible },
                          { "culled", statistics.culled },
                          { "draws", statistics.draws },
                          { "triangles", statistics.triangles },
                          { "lights", statistics.lights },
                          { "passes_run", statistics.passesRun },
                          { "passes_culled", statistics.passesCulled } });
}

py::list timingsOf(DrawingObject const& self) {
    const Owner::Call call(*self.owner());
    py::list list;
    for (FrameTimings const& timings : self->renderer.takeTimings()) {
        std::map<std::string, double> passes; // those of the same name, such as the levels of bloom, together
        for (PassTiming const& pass : timings.passes) passes[pass.name] += pass.gpuMilliseconds;
        py::dict dict;
        dict["frame"] = timings.frame;
        dict["prepare_milliseconds"] = timings.prepareMilliseconds;
        dict["record_milliseconds"] = timings.recordMilliseconds;
        dict["replay_milliseconds"] = timings.replayMilliseconds;
        dict["gpu_milliseconds"] = timings.gpuMilliseconds;
        dict["passes"] = passes;
        list.append(dict);
    }
    return list;
}

} // namespace

void bindRenderer(py::module_& module) {
    module.def(
            "render_aovs", &renderAovsOf, py::arg("engine").none(false), py::arg("scene").none(false),
            py::arg("view").none(false), py::arg("names"), py::kw_only(), py::arg("renderer") = nullptr,
            "Numbers of the surfaces that a view shows, by their names in docs/aovs.md: float32 arrays (height, width, "
            "4), row 0 on top, with 1 in the last channel where there is a value, 0.5 where the material has none, "
            "and 0 where no surface is. motion counts from the last frame of `renderer`; without one it is 0. Other "
            "threads of Python run meanwhile.");
    module.def(
            "render_shares", &renderSharesOf, py::arg("engine").none(false), py::arg("scene").none(false),
            py::arg("view").none(false), py::kw_only(), py::arg("terms") = "lights", py::arg("groups") = LightsByName{},
            py::arg("frames") = 1,
            "What each light or effect adds to render(output='light') of a new renderer: float64 arrays (height, "
            "width, 4) by name, which add up to its bits. terms='lights': by light, those of `groups` (lights by name) "
            "together; 'effects': by effect; 'all': both. Other threads of Python run meanwhile.");
    module.def("explain_pixel", &explainPixelOf, py::arg("engine").none(false), py::arg("scene").none(false),
               py::arg("view").none(false), py::arg("x"), py::arg("y"), py::kw_only(), py::arg("terms") = "all",
               py::arg("frames") = 1,
               "Why a pixel has its light: a dict with the terms of render_shares() there, their sum, and the surface. "
               "docs/shares.md has its members. Other threads of Python run meanwhile.");
    py::class_<DrawingObject, std::shared_ptr<DrawingObject>>(
            module, "Renderer", "Draws scenes to arrays. Keeps what effects gather over frames.")
            .def(py::init(&makeRenderer), py::arg("engine"), py::kw_only(), py::arg("pass_timers") = false)
            .def("render", &render, py::arg("scene").none(false), py::arg("view").none(false), py::kw_only(),
                 py::arg("output") = "display", py::arg("frames") = 1,
                 "Draws so many frames of the view and returns the last: an array (height, width, 4), row 0 on top. "
                 "output='display': uint8 codes, tone mapped; 'light': float32, linear Rec. 709 times the exposure. "
                 "Other threads of Python run meanwhile.")
            .def("render_meshes", &renderMeshes, py::arg("scene").none(false), py::arg("view").none(false),
                 py::arg("material").none(false), py::kw_only(), py::arg("outputs") = 1, py::arg("keep_holes") = false,
                 py::arg("clear") = std::array<float, 4>{},
                 "Draws the objects that the view shows with one unlit material, and returns its outputs: float32 "
                 "arrays (height, width, 4), with `clear` where no object is. keep_holes: objects have the holes of "
                 "their own materials. docs/own-passes.md has examples. Other threads of Python run meanwhile.")
            .def("decisions", &decisionsOf,
                 "What the last frame needed, what it did not, and why: effects first, then passes.")
            .def(
                    "explain",
                    [](DrawingObject const& self) {
                        const Owner::Call call(*self.owner());
                        return self->renderer.explain();
                    },
                    "decisions() as a table, and the frame graph in words.")
            .def(
                    "graphviz",
                    [](DrawingObject const& self) {
                        const Owner::Call call(*self.owner());
                        return self->renderer.graphviz();
                    },
                    "The frame graph of the last frame for graphviz.")
            .def("statistics", &statisticsOf, "Counts of the last frame: renderables, draws, triangles, passes.")
            .def("take_timings", &timingsOf,
                 "Times of the frames since the last call, oldest first. Those of the device need pass_timers; passes "
                 "of the same name count together.");
}

} // namespace filament_core::python

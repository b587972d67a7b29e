// SPDX-License-Identifier: Apache-2.0
// two_windows [vulkan|gles] [FRAMES PREFIX]: two windows of one engine, with views, sizes and rates of their own.
// Resize them, and close one: the other continues. After FRAMES frames a window closes, and PREFIX_NAME.png has what it
// shows.
#include <filament_core/filament_core.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#define GLFW_EXPOSE_NATIVE_X11
#include <GLFW/glfw3native.h>
#include <glm/ext/matrix_transform.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

using namespace filament_core;

namespace {

int fail(Error const& error) {
    std::fprintf(stderr, "two_windows: error: %s\n", error.message.c_str());
    return 1;
}

struct Glfw {
    bool isThere = glfwInit();
    ~Glfw() { glfwTerminate(); }
};

struct Content {
    Owned<Material> material;
    std::vector<Owned<VertexBuffer>> vertices;
    std::vector<Owned<IndexBuffer>> indices;
    std::vector<Owned<MaterialInstance>> paints;
};

Result<void> addThing(Engine& engine, Scene& scene, Content& content, Result<Mesh> const& mesh, double3 position,
                      float3 color) {
    if (!mesh) return mesh.error();
    content.vertices.push_back(engine.own(engine.create(mesh->vertexBuffer())));
    content.indices.push_back(engine.own(engine.create(mesh->indexBuffer())));
    content.paints.push_back(engine.own(engine.createInstance(content.material)));
    scene.add({ .vertices = content.vertices.back(),
                .indices = content.indices.back(),
                .material = content.paints.back(),
                .worldFromObject = glm::translate(double4x4(1), position) });
    return engine.set(content.paints.back(), "baseColor", color);
}

Result<Content> fill(Engine& engine, Scene& scene) {
    const Result<Material> lit = createBuiltInMaterial(engine, "lit");
    if (!lit) return lit.error();
    Content content{ .material = engine.own(*lit) };
    const auto add = [&](Result<Mesh> const& mesh, double3 position, float3 color) {
        return addThing(engine, scene, content, mesh, position, color);
    };
    Result<void> done = add(makePlane({ .width = 4, .depth = 3 }), { 0, 0, 0 }, { 0.5f, 0.5f, 0.5f });
    if (done) done = add(makeBox(), { -1, 0.5, -0.5 }, { 0.8f, 0.2f, 0.1f });
    if (done) done = add(makeCone(), { 0.9, 0.5, -0.4 }, { 0.2f, 0.6f, 0.2f });
    if (done) done = add(makeTorus(), { 0.1, 0.2, 0.7 }, { 0.1f, 0.3f, 0.8f });
    if (!done) return done.error();
    scene.add(SunLight{ .directionWorld = { -0.6f, -1, -0.4f } });
    scene.add(SunLight{ .directionWorld = { 1, -0.5f, -1 }, .illuminance = Lux{ 20'000 }, .castsShadows = false });
    return content;
}

/// Of the first window; it turns around the scene once in twelve seconds.
Camera cameraAt(double seconds) {
    const double angle = seconds * 6.283185307179586 / 12;
    return Camera::lookAt({ 4 * std::sin(angle), 2.2, 4 * std::cos(angle) }, { 0, 0.3, 0 });
}

struct ViewWindow { // X11 has a Window
    const char* name;
    double secondsPerFrame; ///< 0: as often as the display wants images
    View view;
    Renderer renderer; ///< of its own: it keeps shadow maps and histories from frame to frame
    GLFWwindow* handle = nullptr;
    Owned<SwapChain> chain{};
    uint32_t frames = 0;
    double next = 0; ///< when the next frame is due, in seconds

    uint2 pixels() const {
        int width = 0, height = 0;
        glfwGetFramebufferSize(handle, &width, &height);
        return { static_cast<uint32_t>(width), static_cast<uint32_t>(height) };
    }
};

bool open(Engine& engine, ViewWindow& window, int x) {
    const int2 size(window.view.size);
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API); // the engine brings its own
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);     // until it has its place
    window.handle = glfwCreateWindow(size.x, size.y, window.name, nullptr, nullptr);
    if (!window.handle) return false;
    glfwSetWindowPos(window.handle, x, 40);
    glfwShowWindow(window.handle);
    window.view.size = window.pixels();
    window.chain = engine.own(engine.create(
            SwapChainDesc{ .size = window.view.size, .window = NativeWindow::x11(glfwGetX11Window(window.handle)) }));
    std::printf("%s: %u x %u\n", window.name, window.view.size.x, window.view.size.y);
    return true;
}

/// The swap chain first, which uses the window.
void close(ViewWindow& window) {
    window.chain.reset();
    glfwDestroyWindow(window.handle);
    window.handle = nullptr;
    std::printf("%s: closed\n", window.name);
}

/// Whether the window takes a frame now. One that is hidden, or waits for its display, does not hold up the other.
bool wantsFrame(Engine& engine, ViewWindow& window) {
    const uint2 size = window.pixels();
    if (size.x == 0 || size.y == 0) return false; // minimised
    if (size != window.view.size) {
        engine.resize(window.chain, window.view.size = size);
        std::printf("%s: %u x %u\n", window.name, size.x, size.y);
    }
    return glfwGetTime() >= window.next && window.renderer.canPresent(window.chain);
}

void draw(Scene const& scene, ViewWindow& window) {
    window.renderer.render(scene, window.view, window.chain);
    window.renderer.present(window.chain);
    window.next = glfwGetTime() + window.secondsPerFrame;
    ++window.frames;
}

Result<void> save(ViewWindow& window, std::string const& prefix) {
    const Result<Image> image = window.renderer.waitPixels(window.renderer.readPixels(window.chain));
    if (!image) return image.error();
    return savePng(prefix + "_" + window.name + ".png", *image);
}

} // namespace

int main(int argc, char** argv) {
    const bool isVulkan = argc > 1 && std::string_view(argv[1]) == "vulkan";
    const uint32_t mostFrames = argc > 2 ? static_cast<uint32_t>(std::atoi(argv[2])) : 0;
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    const Glfw glfw; // the display lasts longer than the engine
    if (!glfw.isThere) return fail({ ErrorCode::DeviceUnavailable, "no X server: set DISPLAY" });
    Result<Engine> engine = Engine::create({ .backend = isVulkan ? Backend::Vulkan : Backend::Gles,
                                             .display = NativeDisplay::x11(glfwGetX11Display()) });
    if (!engine) return fail(engine.error());
    Scene scene(*engine);
    const Result<Content> content = fill(*engine, scene);
    if (!content) return fail(content.error());

    // The plan shows the first window's camera as lines; ten images a second are enough for it.
    DebugDraw lines;
    const Lens parallel{ .nearMeters = 0.1f, .orthographicHeight = 11, .farMeters = 20 };
    std::array windows{
        ViewWindow{ "scene",
                    0,
                    { .size = { 320, 200 }, .clearColor = { 0.25f, 0.3f, 0.35f, 1 }, .samples = 4 },
                    Renderer(*engine) },
        ViewWindow{ "plan",
                    0.1,
                    { .camera = Camera::lookAt({ 0, 8, 0 }, { 0, 0, 0 }, parallel, {}, { 0, 0, -1 }),
                      .size = { 200, 200 },
                      .clearColor = { 0.1f, 0.1f, 0.12f, 1 },
                      .debugDraw = &lines },
                    Renderer(*engine) },
    };
    for (size_t i = 0; i < windows.size(); ++i) {
        if (!open(*engine, windows[i], i == 0 ? 40 : 520))
            return fail({ ErrorCode::DeviceUnavailable, "the X server has no window for this program" });
    }

    int result = 0;
    while (windows[0].handle || windows[1].handle) {
        bool isIdle = true;
        for (ViewWindow& window : windows) {
            if (window.handle && glfwWindowShouldClose(window.handle)) close(window);
            if (!window.handle || !wantsFrame(*engine, window)) continue;
            isIdle = false;
            // With FRAMES the images do not depend on the clock.
            const Camera camera = cameraAt(mostFrames > 0 ? 0.25 * window.frames : glfwGetTime());
            windows[0].view.camera = camera;
            lines.clear();
            lines.frustum(camera, 1.6f, 4, { .color = { 1, 0.8f, 0.1f, 1 }, .widthPixels = 2 });
            draw(scene, window);
            if (window.frames != mostFrames) continue;
            const Result<void> saved = save(window, argc > 3 ? argv[3] : "two_windows");
            if (!saved) result = fail(saved.error());
            glfwSetWindowShouldClose(window.handle, GLFW_TRUE);
        }
        if (isIdle) glfwWaitEventsTimeout(0.002);
        glfwPollEvents();
        for (std::string const& error : engine->takeErrors()) result = fail({ ErrorCode::DeviceLost, error });
    }
    return result;
}

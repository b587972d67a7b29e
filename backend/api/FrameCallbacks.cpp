// SPDX-License-Identifier: Apache-2.0
#include "backend/api/FrameCallbacks.h"

#include <dlfcn.h>
#include <poll.h>

#include <mutex>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

namespace filament_core::backend {
namespace {

// As wayland-client-core.h declares them, without its types.
struct WaylandClient {
    void* (*createQueue)(void* display) = nullptr;
    void (*destroyQueue)(void* queue) = nullptr;
    void* (*createWrapper)(void* proxy) = nullptr;
    void (*destroyWrapper)(void* wrapper) = nullptr;
    void (*setQueue)(void* proxy, void* queue) = nullptr;
    uint32_t (*versionOf)(void* proxy) = nullptr;
    void* (*marshal)(void* proxy, uint32_t opcode, const void* interface, uint32_t version, uint32_t flags,
                     ...) = nullptr;
    int (*addListener)(void* proxy, void (**functions)(), void* data) = nullptr;
    void (*destroy)(void* proxy) = nullptr;
    int (*prepareRead)(void* display, void* queue) = nullptr;
    int (*read)(void* display) = nullptr;
    void (*cancelRead)(void* display) = nullptr;
    int (*dispatchPending)(void* display, void* queue) = nullptr;
    int (*flush)(void* display) = nullptr;
    int (*fileOf)(void* display) = nullptr;
    const void* callbackInterface = nullptr;
    bool isComplete = true;

    WaylandClient() {
        void* const library = dlopen("libwayland-client.so.0", RTLD_NOW | RTLD_LOCAL);
        const auto load = [&](auto& function, const char* name) {
            function = library ? reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name))
                               : nullptr;
            isComplete = isComplete && function;
        };
        load(createQueue, "wl_display_create_queue");
        load(destroyQueue, "wl_event_queue_destroy");
        load(createWrapper, "wl_proxy_create_wrapper");
        load(destroyWrapper, "wl_proxy_wrapper_destroy");
        load(setQueue, "wl_proxy_set_queue");
        load(versionOf, "wl_proxy_get_version");
        load(marshal, "wl_proxy_marshal_flags");
        load(addListener, "wl_proxy_add_listener");
        load(destroy, "wl_proxy_destroy");
        load(prepareRead, "wl_display_prepare_read_queue");
        load(read, "wl_display_read_events");
        load(cancelRead, "wl_display_cancel_read");
        load(dispatchPending, "wl_display_dispatch_queue_pending");
        load(flush, "wl_display_flush");
        load(fileOf, "wl_display_get_fd");
        load(callbackInterface, "wl_callback_interface");
    }
};

WaylandClient const& client() {
    static const WaylandClient library;
    return library;
}

} // namespace

struct FrameCallbacks::State {
    void* display = nullptr;
    void* queue = nullptr;
    void* surface = nullptr; ///< a wrapper, whose callbacks go to `queue`
    std::shared_ptr<WindowGate> gate;
    std::mutex mutex;
    std::set<void*> awaited; ///< callbacks
    std::atomic<bool> ends{ false };
    std::thread thread;

    ~State() {
        ends.store(true, std::memory_order_relaxed);
        if (thread.joinable()) thread.join();
        for (void* callback : awaited) client().destroy(callback);
        if (surface) client().destroyWrapper(surface);
        if (queue) client().destroyQueue(queue);
        gate->allowed.store(WindowGate::kOpen, std::memory_order_release); // nobody waits for a window that went
    }

    void allow() const { gate->allowed.fetch_add(1, std::memory_order_acq_rel); }

    static void onDone(void* data, void* callback, uint32_t) {
        State& state = *static_cast<State*>(data);
        {
            const std::lock_guard lock(state.mutex);
            state.awaited.erase(callback);
        }
        client().destroy(callback);
        state.allow();
    }

    /// Until the end, or until the connection is lost: then nobody is told, and nobody waits.
    void run() {
        WaylandClient const& wayland = client();
        constexpr int kSliceMilliseconds = 20;
        while (!ends.load(std::memory_order_relaxed)) {
            bool isLost = false;
            while (!isLost && wayland.prepareRead(display, queue) != 0)
                isLost = wayland.dispatchPending(display, queue) < 0;
            if (isLost) break;
            wayland.flush(display);
            pollfd file{ wayland.fileOf(display), POLLIN, 0 };
            if (poll(&file, 1, kSliceMilliseconds) <= 0) {
                wayland.cancelRead(display);
                continue;
            }
            if (wayland.read(display) < 0 || wayland.dispatchPending(display, queue) < 0) break;
        }
        if (!ends.load(std::memory_order_relaxed)) gate->allowed.store(WindowGate::kOpen, std::memory_order_release);
    }
};

FrameCallbacks::FrameCallbacks(std::unique_ptr<State> state) : mState(std::move(state)) {}
FrameCallbacks::~FrameCallbacks() = default;

std::unique_ptr<FrameCallbacks> FrameCallbacks::create(void* display, void* surface, std::shared_ptr<WindowGate> gate) {
    if (!gate || !client().isComplete) return nullptr;
    auto state = std::make_unique<State>();
    state->display = display;
    state->gate = std::move(gate);
    state->queue = client().createQueue(display);
    state->surface = client().createWrapper(surface);
    if (!state->queue || !state->surface) return nullptr;
    client().setQueue(state->surface, state->queue);
    try {
        state->thread = std::thread([it = state.get()] { it->run(); });
    } catch (std::system_error const&) {
        return nullptr;
    }
    state->gate->allowed.store(1, std::memory_order_release); // the first image is wanted
    return std::unique_ptr<FrameCallbacks>(new FrameCallbacks(std::move(state)));
}

void FrameCallbacks::request() {
    WaylandClient const& wayland = client();
    constexpr uint32_t kSurfaceFrame = 3; // wl_surface.frame
    static void (*onDone[])() = { reinterpret_cast<void (*)()>(&State::onDone) };
    const std::lock_guard lock(mState->mutex); // the event comes after the insertion
    void* const callback = wayland.marshal(mState->surface, kSurfaceFrame, wayland.callbackInterface,
                                           wayland.versionOf(mState->surface), 0, nullptr);
    if (!callback) return mState->allow();
    wayland.addListener(callback, onDone, mState.get());
    mState->awaited.insert(callback);
}

void FrameCallbacks::allowAnother() { mState->allow(); }

} // namespace filament_core::backend

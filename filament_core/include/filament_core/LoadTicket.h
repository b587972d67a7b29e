// SPDX-License-Identifier: Apache-2.0
/// LoadTicket: a model or an environment that is loaded in the background.
///   In      the arguments of loadGltf() and loadEnvironment(). Bytes in memory are copied.
///   Out     the same result as theirs, to the bit, whatever the number of workers.
///   Thread  files are read, decoded and baked on background threads of the engine. poll() creates the engine's
///           objects, a slice at a time: call it once a frame. All calls of a ticket belong to the thread of its engine
///           (docs/objects.md). Without workers (EngineOptions::workers = 0) the first part runs inside
///           loadGltfAsync() and loadEnvironmentAsync().
///   Memory  the file, and about twice the result, until take(). Nothing at rest.
///   Cancel  cancel(), or the end of the ticket: at any time, without waiting. A background thread stops before its
///           next image, primitive or step; what was created is destroyed at once.
///   Life    a ticket may outlive its engine, which cancels what is still being loaded when it ends.
///   Errors  those of loadGltf() and loadEnvironment(), from take(); Cancelled after cancel(), or after the end of the
///           engine. Without memory to begin, loadGltfAsync() and loadEnvironmentAsync() throw std::bad_alloc.
///
///   LoadTicket<Model> ticket = loadGltfAsync(engine, "castle.glb");
///   while (!ticket.poll().isFinished()) renderer.render(loadingScreen, view, swapChain);
///   Result<Model> castle = ticket.take();
#pragma once

#include <filament_core/EnumNames.h>
#include <filament_core/Environment.h>
#include <filament_core/Gltf.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

namespace filament_core {
namespace engine {
class LoadTask;
}

enum class LoadStage : uint8_t {
    Waiting,   ///< for a background thread
    Decoding,  ///< reading, decoding, baking
    Creating,  ///< the objects of the engine, by poll()
    Ready,     ///< take() gives the result
    Failed,    ///< take() says why
    Cancelled, ///< by cancel(), or because the engine ended
};
template <>
struct EnumNames<LoadStage> {
    static constexpr std::array<std::string_view, 6> values{ "waiting", "decoding", "creating",
                                                             "ready",   "failed",   "cancelled" };
};

struct LoadStatus {
    LoadStage stage = LoadStage::Waiting;
    /// Steps of Decoding or Creating; a total grows while parts are found, and 0 is not known yet.
    size_t done = 0, total = 0;

    bool isFinished() const { return stage >= LoadStage::Ready; }
};

/// What one poll() may copy to the device. It creates at least one object: a texture with its mip levels, a mesh.
inline constexpr size_t kLoadSliceBytes = size_t{ 8 } << 20;

/// What tickets of all results have in common.
class LoadTicketBase {
public:
    LoadTicketBase(LoadTicketBase&&) noexcept = default;
    LoadTicketBase& operator=(LoadTicketBase&& other) noexcept {
        const LoadTicketBase old(std::exchange(mTask, std::move(other.mTask)));
        return *this;
    }
    /// Cancels what is not finished, and destroys a result that was not taken.
    ~LoadTicketBase();

    /// Creates the next slice of objects, if everything is decoded. Never waits.
    LoadStatus poll(size_t sliceBytes = kLoadSliceBytes);
    /// The current progress; creates nothing.
    LoadStatus status() const;
    /// No effect if finished.
    void cancel();

protected:
    explicit LoadTicketBase(std::shared_ptr<engine::LoadTask> task) : mTask(std::move(task)) {}

    std::shared_ptr<engine::LoadTask> mTask; ///< none: moved from
};

/// T: Model or Environment.
template <class T>
class LoadTicket : public LoadTicketBase {
public:
    /// Once, when poll() says that it is finished; InvalidArgument before that, and the second time.
    Result<T> take();
    /// Waits until it is finished, and takes it.
    Result<T> wait();

    explicit LoadTicket(std::shared_ptr<engine::LoadTask> task) : LoadTicketBase(std::move(task)) {}
};

template <>
Result<Model> LoadTicket<Model>::take();
template <>
Result<Model> LoadTicket<Model>::wait();
template <>
Result<Environment> LoadTicket<Environment>::take();
template <>
Result<Environment> LoadTicket<Environment>::wait();

LoadTicket<Model> loadGltfAsync(Engine& engine, std::filesystem::path const& path, GltfLoadOptions const& options = {});
/// GltfMemory::resolve must be callable until the ticket is finished or cancelled, and for one call more.
LoadTicket<Model> loadGltfAsync(Engine& engine, GltfMemory const& model, GltfLoadOptions const& options = {});
LoadTicket<Environment> loadEnvironmentAsync(Engine& engine, std::filesystem::path const& path,
                                             EnvironmentLoadOptions const& options = {});
LoadTicket<Environment> loadEnvironmentAsync(Engine& engine, std::span<const std::byte> file, std::string_view name,
                                             EnvironmentLoadOptions const& options = {});

} // namespace filament_core

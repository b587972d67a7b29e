// SPDX-License-Identifier: Apache-2.0
#include <filament_core/LoadTicket.h>

#include "base/Result.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/engine/EnvironmentImpl.h"
#include "filament_core/engine/LoadTask.h"
#include "filament_core/engine/gltf/GltfMaterials.h"
#include "filament_core/engine/gltf/ModelUpload.h"

#include <optional>
#include <utility>
#include <vector>

namespace filament_core {
namespace engine {
namespace {

/// A task of an engine, which is used only on its thread, and not after it has ended.
class EngineTask : public LoadTask {
public:
    EngineTask(Engine::Impl& owner, std::string name)
            : LoadTask(std::move(name)), engine(owner), link(owner), jobs(owner.jobs) {}

    Engine::Impl& engine; ///< while the link is alive
    EngineLink link;

protected:
    void sendSlice() override {
        if (engine.stream->replayedSubmissions() == engine.stream->submissions()) engine.flush();
    }

    jobs::JobSystem& jobs; // work() runs before they end
};

/// One that results in a T.
template <class T>
class LoadTaskOf : public EngineTask {
public:
    using EngineTask::EngineTask;

    Result<T> take() {
        if (std::optional<Error> why = error()) return std::move(*why);
        if (!result) return fail(ErrorCode::InvalidArgument, "the result of this load was taken already");
        Result<T> taken(std::move(*result));
        result.reset();
        return taken;
    }

    Result<T> wait() {
        waitForWork();
        while (!poll(kLoadSliceBytes).isFinished()) {
        }
        return take();
    }

protected:
    std::optional<T> result;
};

/// The same, created step by step by an Upload.
template <class T, class Upload>
class UploadTask : public LoadTaskOf<T> {
protected:
    using LoadTaskOf<T>::LoadTaskOf;

    void finish() override {
        this->result.emplace(upload->finish());
        upload.reset();
        this->engine.flush();
    }

    void drop() noexcept override {
        upload.reset();
        this->result.reset();
    }

    std::optional<Upload> upload;
};

class ModelTask : public UploadTask<Model, ModelUpload> {
public:
    ModelTask(Engine::Impl& owner, std::filesystem::path path, GltfLoadOptions const& options)
            : UploadTask(owner, path.filename().string()), mPath(std::move(path)),
              mOptions(gltfOptions(owner, options)), mChoice(GltfMaterials::choiceOf(owner, options.sectionPlanes)) {}
    ModelTask(Engine::Impl& owner, GltfMemory const& model, GltfLoadOptions const& options)
            : UploadTask(owner, model.name), mIsInMemory(true), mFile(model.file.begin(), model.file.end()),
              mOptions(gltfOptions(owner, model, options)),
              mChoice(GltfMaterials::choiceOf(owner, options.sectionPlanes)) {}

private:
    Result<void> work() override {
        mOptions.cancellation = &cancellation();
        mOptions.progress = [this, progress = std::move(mOptions.progress)](assets::GltfStage stage, size_t done,
                                                                            size_t total) {
            setProgress(done, total);
            if (progress) progress(stage, done, total);
        };
        Result<ReadModel> read =
                mIsInMemory ? readModel(mFile, jobs, mOptions, mChoice) : readModel(mPath, jobs, mOptions, mChoice);
        if (!read) return read.error();
        mRead.emplace(std::move(*read));
        return {};
    }

    size_t stepCount() const override {
        return mRead ? mRead->data.images.size() + mRead->data.meshes.size() + 1 : upload->stepCount();
    }

    size_t step(size_t index) override {
        if (mRead) {
            upload.emplace(engine, std::move(*mRead));
            mRead.reset();
        }
        return upload->step(index);
    }

    bool mIsInMemory = false;
    std::filesystem::path mPath;
    std::vector<std::byte> mFile; // instead of a path
    assets::GltfOptions mOptions;
    const GltfMaterialChoice mChoice;
    std::optional<ReadModel> mRead; // by work(), until the first step
};

class EnvironmentTask : public UploadTask<Environment, EnvironmentUpload> {
public:
    EnvironmentTask(Engine::Impl& owner, std::filesystem::path path, EnvironmentLoadOptions const& options)
            : UploadTask(owner, path.filename().string()), mName(path.filename().string()), mPath(std::move(path)),
              mOptions(environmentOptions(owner, options)) {}
    EnvironmentTask(Engine::Impl& owner, std::span<const std::byte> file, std::string_view name,
                    EnvironmentLoadOptions const& options)
            : UploadTask(owner, std::string(name)), mName(name), mIsInMemory(true), mFile(file.begin(), file.end()),
              mOptions(environmentOptions(owner, options)) {}

private:
    Result<void> work() override {
        mOptions.cancellation = &cancellation();
        mOptions.progress = [this, progress = std::move(mOptions.progress)](std::string_view stage, size_t done,
                                                                            size_t total) {
            setProgress(done, total);
            if (progress) progress(stage, done, total);
        };
        Result<assets::EnvironmentData> read = mIsInMemory
                                                       ? assets::loadEnvironmentFromMemory(mFile, mName, jobs, mOptions)
                                                       : assets::loadEnvironment(mPath, jobs, mOptions);
        if (!read) return read.error();
        mRead.emplace(std::move(*read));
        return {};
    }

    size_t stepCount() const override { return EnvironmentUpload::kSteps; }

    size_t step(size_t index) override {
        if (!upload) upload.emplace(engine, std::move(*mRead), mName);
        return upload->step(index);
    }

    std::string mName;
    bool mIsInMemory = false;
    std::filesystem::path mPath;
    std::vector<std::byte> mFile; // instead of a path
    assets::EnvironmentOptions mOptions;
    std::optional<assets::EnvironmentData> mRead; // by work(), until the first step
};

template <class T>
LoadTicket<T> begin(Engine& engine, std::shared_ptr<LoadTask> task) {
    engine.impl().loads.add(task);
    LoadTask::start(task, engine.impl().jobs);
    return LoadTicket<T>(std::move(task));
}

/// A function of a ticket, from its first line to its last. A ticket may outlive its engine.
class TicketCall {
public:
    TicketCall(std::shared_ptr<LoadTask> const& ofTicket, const char* function)
            : mCall(function), task(static_cast<EngineTask&>(existing(ofTicket))) {
        if (task.link.isAlive()) const PublicCall checksThread(&task, function);
    }

private:
    static LoadTask& existing(std::shared_ptr<LoadTask> const& task) {
        if (!task) misused("the ticket was moved from; use the one that it was moved to");
        return *task;
    }

    ApiCall mCall;

public:
    EngineTask& task;
};

template <class T>
LoadTaskOf<T>& taskOf(TicketCall const& call) {
    return static_cast<LoadTaskOf<T>&>(call.task);
}

} // namespace
} // namespace engine

using engine::TicketCall;

LoadTicketBase::~LoadTicketBase() {
    if (!mTask) return; // moved from
    const TicketCall call(mTask, "LoadTicket::~LoadTicket()");
    mTask->discard();
}

LoadStatus LoadTicketBase::poll(size_t sliceBytes) {
    const TicketCall call(mTask, "LoadTicket::poll(size_t)");
    return call.task.poll(sliceBytes);
}

LoadStatus LoadTicketBase::status() const {
    const TicketCall call(mTask, "LoadTicket::status()");
    return call.task.status();
}

void LoadTicketBase::cancel() {
    const TicketCall call(mTask, "LoadTicket::cancel()");
    call.task.cancel();
}

template <>
Result<Model> LoadTicket<Model>::take() {
    const TicketCall call(mTask, "LoadTicket::take()");
    return engine::taskOf<Model>(call).take();
}

template <>
Result<Environment> LoadTicket<Environment>::take() {
    const TicketCall call(mTask, "LoadTicket::take()");
    return engine::taskOf<Environment>(call).take();
}

template <>
Result<Model> LoadTicket<Model>::wait() {
    const TicketCall call(mTask, "LoadTicket::wait()");
    return engine::taskOf<Model>(call).wait();
}

template <>
Result<Environment> LoadTicket<Environment>::wait() {
    const TicketCall call(mTask, "LoadTicket::wait()");
    return engine::taskOf<Environment>(call).wait();
}

LoadTicket<Model> loadGltfAsync(Engine& engine, std::filesystem::path const& path, GltfLoadOptions const& options) {
    const engine::PublicCall call(engine, "loadGltfAsync(Engine, path)", path.native());
    return engine::begin<Model>(engine, std::make_shared<engine::ModelTask>(engine.impl(), path, options));
}

LoadTicket<Model> loadGltfAsync(Engine& engine, GltfMemory const& model, GltfLoadOptions const& options) {
    const engine::PublicCall call(engine, "loadGltfAsync(Engine, GltfMemory)", model.name);
    return engine::begin<Model>(engine, std::make_shared<engine::ModelTask>(engine.impl(), model, options));
}

LoadTicket<Environment> loadEnvironmentAsync(Engine& engine, std::filesystem::path const& path,
                                             EnvironmentLoadOptions const& options) {
    const engine::PublicCall call(engine, "loadEnvironmentAsync(Engine, path)", path.native());
    return engine::begin<Environment>(engine, std::make_shared<engine::EnvironmentTask>(engine.impl(), path, options));
}

LoadTicket<Environment> loadEnvironmentAsync(Engine& engine, std::span<const std::byte> file, std::string_view name,
                                             EnvironmentLoadOptions const& options) {
    const engine::PublicCall call(engine, "loadEnvironmentAsync(Engine, span<byte>, string_view)", name);
    return engine::begin<Environment>(engine,
                                      std::make_shared<engine::EnvironmentTask>(engine.impl(), file, name, options));
}

} // namespace filament_core

// SPDX-License-Identifier: Apache-2.0
// What a viewer reads and writes: files, the clipboard, images, recordings.
#include "tools/view/app/OpenFiles.h"
#include "tools/view/app/Viewer.h"
#include "tools/view/document/DocumentScene.h"
#include "tools/view/panels/MaterialRows.h"

#include <filament_core/SaveGltf.h>

#include <fmt/format.h>

namespace filament_core::view {
namespace {

PictureFormat pictureFormatOf(FrameKind kind) {
    return kind == FrameKind::Exr ? PictureFormat::Exr : PictureFormat::Png;
}

/// For other programs; returns what happened, in words.
std::string saveSceneFile(std::filesystem::path const& file, Document const& document, bool modelHasLight) {
    const Result<DocumentScene> scene = sceneOf(document, modelHasLight);
    if (!scene) return "no scene file: " + scene.error().message;
    if (const Result<void> saved = scene->file.save(file); !saved) return saved.error().message;
    std::string text = fmt::format("saved {}", file.string());
    for (size_t i = 0; i < scene->missing.size(); ++i)
        text += fmt::format("{} {}", i == 0 ? ", without" : ",", scene->missing[i]);
    return text;
}

} // namespace

/// In the place of the texture that is chosen in the panel of materials.
void Viewer::openPicture(std::filesystem::path const& file) {
    std::optional<TextureTarget> const& target = mPanels.state.textureTarget;
    if (!target) return note("choose a texture in the panel Materials first: the picture takes its place");
    setTexture(mDocument, target->material, target->parameter, file, holdsData(target->parameter));
    touch();
}

void Viewer::open(std::filesystem::path const& file) {
    mGizmo.letGo(); // it would bring back the edits from before its drag
    if (kindOf(file) == FileKind::Picture) return openPicture(file);
    const size_t paths = mDocument.paths.size();
    if (const Result<void> shown = showFile(mDocument, file); !shown) return note(shown.error().message);
    if (mDocument.paths.size() > paths) mPanels.state.path = { .path = mDocument.paths.size() - 1 };
    const Result<void> kept = mRecent.add(file);
    mPanels.fileDialog.recent = mRecent.files();
    if (!kept) note(kept.error().message);
    touch();
}

void Viewer::followFileDialog() {
    const std::optional<ChosenFile> chosen = mPanels.fileDialog.takeChosen();
    if (!chosen) return;
    touch();
    PathState& state = mPanels.state.path;
    switch (chosen->purpose) {
    case FilePurpose::Open:
        return open(chosen->file);
    case FilePurpose::OpenPath: {
        Result<CameraPath> path = loadCameraPath(chosen->file);
        if (!path) return note(path.error().message);
        mDocument.paths.push_back(std::move(*path));
        state = { .path = mDocument.paths.size() - 1 };
        return;
    }
    case FilePurpose::SavePath: {
        if (mDocument.paths.empty()) return;
        const Result<void> saved = saveCameraPath(chosen->file, shownPath(mDocument, state));
        return note(saved ? fmt::format("saved {}", chosen->file.string()) : saved.error().message);
    }
    case FilePurpose::SavePicture:
        return mPictures.save(*mStage, chosen->file, pictureFormatOf(chosen->file).value_or(PictureFormat::Png));
    }
}

void Viewer::copy(std::string const& text, const char* what) {
    mInput.copy(text);
    note(fmt::format("copied the {}", what));
}

void Viewer::paste() {
    Result<AnyText> text = anyFromJson(mInput.pasted(), "the clipboard");
    if (!text) return note(text.error().message);
    mGizmo.letGo();
    const bool isPath = std::holds_alternative<CameraPath>(*text);
    showText(mDocument, std::move(*text));
    if (isPath) mPanels.state.path = { .path = mDocument.paths.size() - 1 };
}

/// "viewer-3.png": the first that is not there yet.
std::filesystem::path Viewer::freshName(const char* ending) const {
    for (uint32_t i = 1;; ++i) {
        std::filesystem::path file = mOptions.out / fmt::format("viewer-{}{}", i, ending);
        std::error_code ignored;
        if (!std::filesystem::exists(file, ignored) && !mPictures.isWriting(file)) return file;
    }
}

void Viewer::saveDocumentFile() {
    const std::filesystem::path file = freshName(".json");
    const Result<void> saved = saveDocument(file, mDocument);
    note(saved ? fmt::format("saved {}", file.string()) : saved.error().message);
    if (!saved) return;
    mSaved = mDocument;
    Model const* model = mStage ? mStage->model() : nullptr; // null without a device
    std::filesystem::path sceneFile = file;
    note(saveSceneFile(sceneFile.replace_extension(".scene.json"), mDocument, model && model->environment()));
}

/// With its camera, and what lights it by name.
void Viewer::saveScene() {
    if (!mStage) return note("there is no scene to save");
    const std::filesystem::path file = freshName(".glb");
    const GltfSaveOptions options{ .cameras = { { "view", mDocument.view.camera } },
                                   .environment = mDocument.environment.file.string() };
    const Result<SavedGltf> saved = saveGltf(mStage->scene(), file, options);
    if (!saved) return note(saved.error().message);
    for (std::string const& warning : saved->warnings) note(warning);
    note(fmt::format("saved {}", file.string()));
}

void Viewer::keepEdits() {
    if (mOptions.recentFiles.empty() || isSameEdit(mDocument, mSaved)) return;
    const std::filesystem::path file = mOptions.recentFiles.parent_path() / "last.json";
    const Result<void> saved = saveDocument(file, mDocument);
    note(saved ? fmt::format("edits that were not saved: filament-view --document {} opens them", file.string())
               : saved.error().message);
}

void Viewer::savePicture() {
    const PictureFormat format = pictureFormatOf(mPanels.state.pictureKind);
    mPictures.save(*mStage, freshName(endingOf(format)), format);
}

void Viewer::saveFrame() {
    if (mSaver.isBusy() || mReadsFrame) return note("a frame is being saved");
    mReadsFrame = true;
    note("saving the frame ...");
    const auto start = [this, document = mDocument](Image shown) {
        mReadsFrame = false;
        if (shown.pixels.empty()) return note("the frame was not saved: the device drew no picture");
        mSaver.start(freshName(".frame"), document, std::move(shown), mOptions.workers);
    };
    mPictures.read(*mStage, Format::RGBA8, PictureFrame::New, start);
}

void Viewer::recordPath() {
    if (mDocument.paths.empty()) return note("there is no camera path");
    PathRequest request{ .document = mDocument,
                         .path = shownPath(mDocument, mPanels.state.path),
                         .engine = engineOptions(mStage->engine().device().backend) };
    request.engine.display = {};
    RecordingSettings const& recording = mPanels.state.recording;
    request.series.framesPerSecond = recording.framesPerSecond;
    request.series.format = pictureFormatOf(recording.kind);
    if (recording.kind == FrameKind::Video)
        request.series.video = freshName(".mp4");
    else
        request.series.folder = freshName(".frames");
    mRecorder.start(std::move(request));
}

void Viewer::pollSaving() {
    for (std::string& line : mPictures.poll(*mStage)) note(std::move(line));
    if (auto lines = mSaver.poll())
        for (std::string& line : *lines) note(std::move(line));
    if (auto lines = mRecorder.poll())
        for (std::string& line : *lines) note(std::move(line));
    PathProgress const& progress = mRecorder.progress();
    const RecordingProgress now{ mRecorder.isBusy(), progress.done, progress.total };
    if (std::exchange(mPanels.inputs.recording, now) != now) touch();
}

} // namespace filament_core::view

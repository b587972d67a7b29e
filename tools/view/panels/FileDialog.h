// SPDX-License-Identifier: Apache-2.0
/// FileDialog: chooses a file to open, or a name to save to, in a window of the interface.
///   Keys     typing filters; up and down select; Enter opens the folder or takes the file. While saving, what is typed
///            is the name, and Enter takes it; Backspace in an empty field goes to the folder above; Escape closes. A
///            path that is typed is gone to.
///   Disk     folders are listed, and paths looked up, on threads of their own: a slow disk delays the dialog, no
///            frame. What is typed or clicked before the answer drops the question.
///   Use      open(), draw() once a frame, takeChosen().
///   Thread   that of ImGui's context.
///   Life     its end waits for what is being read.
///   Cost     of draw(): the rows that are seen; all entries when the folder or the filter changes.
#pragma once

#include "tools/view/panels/FolderList.h"
#include "tools/view/stage/Background.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace filament_core::view {

enum class FilePurpose : uint8_t { Open, OpenPath, SavePath, SavePicture };
bool isSaving(FilePurpose purpose);
/// What the dialog lists for it: lower case, with the dot.
std::span<const std::string_view> endingsOf(FilePurpose purpose);

struct ChosenFile {
    FilePurpose purpose = FilePurpose::Open;
    std::filesystem::path file{}; ///< absolute; of a file that is saved: with one of the endings
};

class FileDialog {
public:
    FileDialog() = default;
    FileDialog(FileDialog const&) = delete;
    FileDialog& operator=(FileDialog const&) = delete;

    /// `name`: of the file to save. It begins in the folder that was shown last, or in the current one.
    void open(FilePurpose purpose, std::string name = {});
    void close();
    bool isOpen() const { return mIsOpen; }
    void draw();
    std::optional<ChosenFile> takeChosen() { return std::exchange(mChosen, std::nullopt); }

    /// Shown above the folder, newest first.
    std::vector<std::filesystem::path> recent{};

    void goTo(std::filesystem::path const& folder); ///< normalised; what is relative begins in the current folder
    std::filesystem::path const& folder() const { return mFolder; }
    FolderList const& list() const { return mList; }
    bool isReading() const { return mReading || mLooking; } ///< draw() is to be called soon, to show the answer

private:
    /// A path that was typed or clicked, on the disk.
    struct Typed {
        std::filesystem::path path{}; ///< of a file that is saved: with one of the endings
        PathKind kind = PathKind::Missing;
    };

    void poll();
    void follow(Typed const& typed);
    void updateShown();
    void drawOrder();
    void drawRecent();
    void drawEntries();
    std::optional<size_t> drawRow(size_t row); ///< `row` if it was clicked twice
    bool drawField(bool hasKeys);
    void drawButtons();
    void walk();
    void enter(); ///< what is selected or written
    void enterEntry(FolderEntry const& entry);
    void lookUp(std::filesystem::path typed);
    void dropQuestion();
    void choose(std::filesystem::path const& file);

    FilePurpose mPurpose = FilePurpose::Open;
    bool mIsOpen = false, mIsNew = false;
    std::filesystem::path mFolder{};
    FolderList mList{};
    std::optional<Background<FolderList>> mReading{};
    std::optional<Background<Typed>> mLooking{};
    Abandoned mAbandoned{};
    std::string mField{};               ///< the filter, or the name
    std::vector<size_t> mShown{};       ///< of mList: what matches mShownFilter
    std::string mShownFilter{};         ///< of mShown
    bool mIsShownCurrent = false;       ///< mShown is of this mList
    size_t mSelected = 0;               ///< of mShown
    bool mHasMoved = false;             ///< the selection, so that it is scrolled to
    std::filesystem::path mToReplace{}; ///< exists: saved to if it is chosen again
    std::optional<ChosenFile> mChosen{};
};

} // namespace filament_core::view

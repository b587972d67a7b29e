// SPDX-License-Identifier: Apache-2.0
// Folders as a file dialog lists them, and the dialog by keys alone: without a device.
#include "tools/view/panels/FileDialog.h"
#include "tests/filament_core/engine/RenderFixture.h"
#include "tools/view/ui/ImGuiVersions.h"
#include "tools/view/ui/UiContext.h"

#include <gmock/gmock.h>

#include <time.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <thread>

namespace filament_core::view {
namespace {

namespace fs = std::filesystem;
using filament_core::test::folderOfThisTest;

/// Empty; no other test has it.
fs::path folderOfTest() {
    const fs::path folder = folderOfThisTest();
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
}
double threadSeconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}
void write(fs::path const& file) { std::ofstream(file) << "text"; }

std::vector<std::string> namesOf(FolderList const& list) {
    std::vector<std::string> names;
    for (FolderEntry const& entry : list.entries) names.push_back(entry.name);
    return names;
}

TEST(FolderList, ListsFoldersThenFilesByNameAndNumber) {
    const fs::path folder = folderOfTest();
    for (const char* name : { "view 10.glb", "view 9.glb", "View 009b.GLB", "Beta.gltf", "alpha.glb", "notes.txt" })
        write(folder / name);
    write(folder / ".hidden.glb");
    fs::create_directories(folder / "zoo");
    fs::create_directories(folder / "Ark");
    fs::create_symlink("nowhere", folder / "broken.glb");
    const FolderList models = listFolder(folder, std::array<std::string_view, 2>{ ".glb", ".gltf" });
    EXPECT_THAT(namesOf(models), testing::ElementsAre("Ark", "zoo", "alpha.glb", "Beta.gltf", "view 9.glb",
                                                      "View 009b.GLB", "view 10.glb"));
    EXPECT_TRUE(models.entries[0].isFolder);
    EXPECT_EQ(models.entries[2].bytes, 4u);
    EXPECT_TRUE(models.error.empty());
    EXPECT_EQ(listFolder(folder, {}).entries.size(), 8u) << "all files";
    const FolderList missing = listFolder(folder / "missing", {});
    EXPECT_TRUE(missing.entries.empty());
    EXPECT_THAT(missing.error, testing::HasSubstr("cannot be read"));
}

TEST(FolderList, TheOrderOfNamesIsAnOrder) {
    const std::vector<std::string> names{ "",    "0",   "00", "1", "01",       "1a",
                                          "01a", "10",  "9",  "a", "A",        "a1",
                                          "A01", "a10", "b",  "-", "99999999", "a99999999999999999999",
                                          "\xff" };
    std::vector<FolderEntry> entries;
    for (std::string const& name : names) entries.push_back({ .name = name });
    for (FolderEntry const& a : entries) {
        EXPECT_FALSE(comesBefore(a, a)) << a.name;
        for (FolderEntry const& b : entries) {
            EXPECT_EQ(a.name != b.name, comesBefore(a, b) || comesBefore(b, a)) << a.name << " " << b.name;
            EXPECT_FALSE(comesBefore(a, b) && comesBefore(b, a)) << a.name << " " << b.name;
            for (FolderEntry const& c : entries)
                if (comesBefore(a, b) && comesBefore(b, c)) {
                    EXPECT_TRUE(comesBefore(a, c)) << a.name << " " << b.name << " " << c.name;
                }
        }
    }
}

TEST(FolderList, NamesOfAnyBytesCanBeDrawn) {
    EXPECT_EQ(shownName("caf\xc3\xa9.glb"), "caf\xc3\xa9.glb");
    EXPECT_EQ(shownName("a\nb\x7f"), "a?b?");
    EXPECT_EQ(shownName("\xff\xc3"), "??");
    EXPECT_EQ(shownName("\xe2\x82"), "??") << "a character that is cut";
    EXPECT_EQ(shownName("\xe2\x82\xac"), "\xe2\x82\xac");
    EXPECT_EQ(shownName("\xe0\x80\x80"), "???") << "longer than it must be";
    EXPECT_EQ(shownName("\xed\xa0\x80"), "???") << "half of a surrogate pair";
    EXPECT_EQ(shownName("\xf4\x90\x80\x80"), "????") << "beyond the last character";
}

/// A dialog, an interface and a keyboard.
class FileDialogTest : public testing::Test {
protected:
    FileDialogTest() : mFolder(folderOfTest()) {
        ImGuiIO& io = ImGui::GetIO();
        prepareKeys(io);
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        io.MousePos = { -1000, -1000 };
        for (const char* name : { "bird.glb", "cat.glb", "dog.glb", "room.hdr", "notes.txt" }) write(mFolder / name);
        fs::create_directories(mFolder / "attic");
        write(mFolder / "attic/ant.glb");
    }
    void frame() {
        mContext.newFrame({ 800, 600 }, 1.0f / 60);
        dialog.draw();
        ImGui::Render();
    }
    /// Until the disk has answered, however many frames that takes.
    void settle() {
        for (int i = 0; i < 3; ++i) frame();
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
        while (dialog.isReading() && std::chrono::steady_clock::now() < deadline) {
            std::this_thread::yield();
            frame();
        }
        EXPECT_FALSE(dialog.isReading()) << "after a minute";
        frame();
    }
    void open(FilePurpose purpose = FilePurpose::Open, std::string name = {}) {
        dialog.open(purpose, std::move(name));
        dialog.goTo(mFolder);
        settle();
    }
    /// One frame, in which nothing that the disk has to say can be known yet.
    void pressOnly(ImGuiKey key) {
        ImGuiIO& io = ImGui::GetIO();
        setKey(io, key, true);
        frame();
        setKey(io, key, false);
    }
    void press(ImGuiKey key) {
        pressOnly(key);
        settle();
    }
    /// Processor time of the fastest of some frames.
    double secondsOfFrame() {
        double least = 1e9;
        for (int i = 0; i < 30; ++i) {
            const double begin = threadSeconds();
            frame();
            least = std::min(least, threadSeconds() - begin);
        }
        return least;
    }
    /// The background of the selected row is drawn: it is not scrolled out of sight.
    static bool isSelectionSeen() {
        const ImU32 color = ImGui::GetColorU32(ImGuiCol_Header);
        ImDrawData const& data = *ImGui::GetDrawData();
        for (ImDrawList const* list : drawLists(data))
            for (ImDrawVert const& vertex : list->VtxBuffer)
                if (vertex.col == color) return true;
        return false;
    }
    void type(const char* text) {
        ImGui::GetIO().AddInputCharactersUTF8(text);
        settle();
    }

    fs::path mFolder;
    UiContext mContext;
    FileDialog dialog;
};

TEST_F(FileDialogTest, KeysWalkAndOpen) {
    open();
    EXPECT_TRUE(ImGui::GetIO().WantTextInput) << "keys are the dialog's";
    EXPECT_THAT(namesOf(dialog.list()), testing::ElementsAre("attic", "bird.glb", "cat.glb", "dog.glb", "room.hdr"));
    press(ImGuiKey_DownArrow);
    press(ImGuiKey_DownArrow);
    press(ImGuiKey_UpArrow);
    press(ImGuiKey_Enter);
    const std::optional<ChosenFile> chosen = dialog.takeChosen();
    ASSERT_TRUE(chosen.has_value());
    EXPECT_EQ(chosen->file, mFolder / "bird.glb");
    EXPECT_EQ(chosen->purpose, FilePurpose::Open);
    EXPECT_FALSE(dialog.isOpen());
    EXPECT_FALSE(dialog.takeChosen().has_value());
}

TEST_F(FileDialogTest, EnterGoesIntoFoldersAndBackspaceOut) {
    open();
    press(ImGuiKey_Enter);
    EXPECT_EQ(dialog.folder(), mFolder / "attic");
    EXPECT_THAT(namesOf(dialog.list()), testing::ElementsAre("ant.glb"));
    press(ImGuiKey_Backspace);
    EXPECT_EQ(dialog.folder(), mFolder);
    press(ImGuiKey_Escape);
    EXPECT_FALSE(dialog.isOpen());
    EXPECT_FALSE(dialog.takeChosen().has_value());
}

TEST_F(FileDialogTest, TypingFilters) {
    open();
    type("DOG");
    press(ImGuiKey_Enter);
    const std::optional<ChosenFile> chosen = dialog.takeChosen();
    ASSERT_TRUE(chosen.has_value());
    EXPECT_EQ(chosen->file, mFolder / "dog.glb");
}

TEST_F(FileDialogTest, PathsThatAreTypedAreGoneTo) {
    open();
    type((mFolder / "attic").c_str());
    press(ImGuiKey_Enter);
    EXPECT_EQ(dialog.folder(), mFolder / "attic");
    type("../nothing/here.glb");
    press(ImGuiKey_Enter);
    EXPECT_TRUE(dialog.isOpen()) << "there is no such file";
    EXPECT_FALSE(dialog.takeChosen().has_value());
}

TEST_F(FileDialogTest, SavingNamesTheFileAndAsksBeforeItReplaces) {
    write(mFolder / "old.png");
    open(FilePurpose::SavePicture, "new");
    press(ImGuiKey_Enter);
    std::optional<ChosenFile> chosen = dialog.takeChosen();
    ASSERT_TRUE(chosen.has_value());
    EXPECT_EQ(chosen->file, mFolder / "new.png") << "with the first ending";
    open(FilePurpose::SavePicture, "old.png");
    press(ImGuiKey_Enter);
    EXPECT_FALSE(dialog.takeChosen().has_value());
    EXPECT_TRUE(dialog.isOpen());
    press(ImGuiKey_Enter);
    chosen = dialog.takeChosen();
    ASSERT_TRUE(chosen.has_value());
    EXPECT_EQ(chosen->file, mFolder / "old.png");
    open(FilePurpose::SavePicture, "light.exr");
    press(ImGuiKey_Enter);
    EXPECT_EQ(dialog.takeChosen()->file, mFolder / "light.exr");
}

TEST_F(FileDialogTest, PathsAreLookedUpBesideTheInterface) {
    open();
    type((mFolder / "cat.glb").c_str());
    pressOnly(ImGuiKey_Enter);
    EXPECT_TRUE(dialog.isReading()) << "the frame did not wait for the disk";
    EXPECT_TRUE(dialog.isOpen());
    settle();
    EXPECT_EQ(dialog.takeChosen()->file, mFolder / "cat.glb");
    open(FilePurpose::SavePicture, "new.png");
    pressOnly(ImGuiKey_Enter);
    EXPECT_TRUE(dialog.isReading());
    settle();
    EXPECT_EQ(dialog.takeChosen()->file, mFolder / "new.png");
}

TEST_F(FileDialogTest, ClosingDropsTheQuestionThatTheDiskHasNotAnswered) {
    open(FilePurpose::SavePicture, "new.png");
    pressOnly(ImGuiKey_Enter);
    dialog.close();
    EXPECT_FALSE(dialog.isReading());
    settle();
    EXPECT_FALSE(dialog.takeChosen().has_value());
}

TEST_F(FileDialogTest, AFolderOfThatNameIsEnteredAndNotReplaced) {
    fs::create_directories(mFolder / "shots.png");
    open(FilePurpose::SavePicture, "shots");
    press(ImGuiKey_Enter);
    EXPECT_EQ(dialog.folder(), mFolder / "shots.png");
    EXPECT_TRUE(dialog.isOpen());
    EXPECT_FALSE(dialog.takeChosen().has_value());
}

TEST_F(FileDialogTest, TenThousandFilesCostAFrameNoMoreThanForty) {
    const auto fill = [&](const char* name, int files) {
        fs::create_directories(mFolder / name);
        for (int i = 0; i < files; ++i) write(mFolder / name / (std::to_string(i) + ".glb"));
        open();
        dialog.goTo(mFolder / name);
        settle();
    };
    fill("few", 40);
    ASSERT_EQ(dialog.list().entries.size(), 40u);
    const double few = secondsOfFrame();
    fill("many", static_cast<int>(kMostEntries));
    ASSERT_EQ(dialog.list().entries.size(), kMostEntries);
    EXPECT_LT(secondsOfFrame(), 5 * few);
    EXPECT_TRUE(isSelectionSeen()) << "the first row";
    for (int i = 0; i < 12; ++i) press(ImGuiKey_PageDown);
    EXPECT_TRUE(isSelectionSeen()) << "row 120";
    press(ImGuiKey_Enter);
    EXPECT_EQ(dialog.takeChosen()->file, mFolder / "many/120.glb");
}

TEST(FolderList, ToldApartAreFilesFoldersAndOthers) {
    const fs::path folder = folderOfTest();
    write(folder / "file");
    fs::create_symlink("file", folder / "link");
    fs::create_symlink("nowhere", folder / "broken");
    EXPECT_EQ(kindOfPath(folder), PathKind::Folder);
    EXPECT_EQ(kindOfPath(folder / "file"), PathKind::File);
    EXPECT_EQ(kindOfPath(folder / "link"), PathKind::File);
    EXPECT_EQ(kindOfPath(folder / "broken"), PathKind::Missing);
    EXPECT_EQ(kindOfPath(folder / "file/below"), PathKind::Missing) << "a file is no folder";
    EXPECT_EQ(kindOfPath("/dev/null"), PathKind::Other);
}

TEST_F(FileDialogTest, AFolderThatIsGoneSaysSo) {
    open();
    dialog.goTo(mFolder / "gone");
    settle();
    EXPECT_THAT(dialog.list().error, testing::HasSubstr("cannot be read"));
    press(ImGuiKey_Enter);
    EXPECT_TRUE(dialog.isOpen());
}

} // namespace
} // namespace filament_core::view

// SPDX-License-Identifier: Apache-2.0
// Wavefront, "Object Files (.obj)", appendix B1 of the Advanced Visualizer's manual.
#include "filament_core/assets/meshfiles/MeshFile.h"
#include "filament_core/assets/meshfiles/MeshWords.h"
#include "filament_core/assets/meshfiles/PolygonTriangles.h"

#include <array>
#include <map>
#include <unordered_map>

namespace filament_core::assets {
namespace {

constexpr size_t kMostParts = 1'000'000;

/// Positions, coordinates and normals of one corner, from 0; -1: none.
struct Corner {
    int64_t position = -1, uv = -1, normal = -1;
    friend bool operator==(Corner const&, Corner const&) = default;
};

struct CornerHash {
    size_t operator()(Corner const& corner) const {
        uint64_t hash = static_cast<uint64_t>(corner.position) * 0x9E3779B97F4A7C15ull;
        hash = (hash ^ static_cast<uint64_t>(corner.uv)) * 0xC2B2AE3D27D4EB4Full;
        return (hash ^ hash >> 29 ^ static_cast<uint64_t>(corner.normal)) * 0x165667B19E3779F9ull >> 7;
    }
};

class ObjReader {
public:
    ObjReader(ReadNeighbour const& read, Diagnostics& diagnostics) : mRead(read), mDiagnostics(diagnostics) {}

    Result<MeshFile> read(std::string_view text) {
        if (text.starts_with("\xFE\xFF") || text.starts_with("\xFF\xFE"))
            return fail(ErrorCode::Unsupported, "the text is UTF-16: save it as UTF-8");
        if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
        std::string joined;
        while (!text.empty() && mError.empty()) {
            ++mLine;
            std::string_view line = takeLine(text);
            if (!trimmed(line).ends_with('\\')) {
                readLine(line);
                continue;
            }
            joined.clear();
            while (trimmed(line).ends_with('\\')) { // the next line continues it
                joined += trimmed(line).substr(0, trimmed(line).size() - 1);
                joined += ' ';
                if (text.empty()) break;
                ++mLine;
                line = takeLine(text);
            }
            if (!trimmed(line).ends_with('\\')) joined += line;
            readLine(joined);
        }
        if (!mError.empty()) return fail(ErrorCode::Corrupt, "line {}: {}", mLine, mError);
        for (Part& part : mParts) finish(part);
        return std::move(mFile);
    }

private:
    struct Part {
        MeshFilePart mesh{};
        std::unordered_map<Corner, uint32_t, CornerHash> vertices{};
        bool hasUvs = true, hasNormals = true, hasColors = true; ///< in all corners
    };

    void readLine(std::string_view line) {
        line = line.substr(0, line.find('#'));
        const std::string_view word = takeWord(line);
        if (word.empty()) return;
        if (word == "v") return readPosition(line);
        if (word == "vt") return readUv(line);
        if (word == "vn") return readNormal(line);
        if (word == "f") return readFace(line);
        if (word == "usemtl") return useMaterial(trimmed(line));
        if (word == "mtllib") return readMaterials(trimmed(line));
        if (word == "o" || word == "g") {
            mName = trimmed(line);
            mPart = nullptr;
            return;
        }
        if (word == "s") return; // normals are those of the file, or of the triangles
        if (word == "l" || word == "p") return mDiagnostics.warn("lines and points are not read");
        mDiagnostics.warn("'{}' is not read", shown(word));
    }

    /// Printable ASCII, and not much of it.
    static std::string shown(std::string_view word) {
        std::string text(word.substr(0, 32));
        for (char& c : text)
            if (c < ' ' || c > '~') c = '?';
        return text;
    }

    /// The numbers of a line; how many there were.
    size_t readNumbers(std::string_view line, std::span<float> numbers) {
        size_t count = 0;
        for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line)) {
            const std::optional<float> number = floatOf(word);
            if (!number) {
                mError = fmt::format("'{}' is not a number", shown(word));
                return 0;
            }
            if (count < numbers.size()) numbers[count] = *number;
            ++count;
        }
        return count;
    }

    void readPosition(std::string_view line) {
        std::array<float, 6> n{};
        const size_t count = readNumbers(line, n);
        if (mError.empty() && count < 3) mError = "a position needs three numbers";
        mPositions.push_back({ n[0], n[1], n[2] });
        // six numbers are a colour; a fourth is a weight of curves
        const bool isColored = count == 6;
        if (isColored) mColors.resize(mPositions.size() - 1, float3(1.0f)), mColors.push_back({ n[3], n[4], n[5] });
    }

    void readUv(std::string_view line) {
        std::array<float, 2> n{};
        const size_t count = readNumbers(line, n);
        if (mError.empty() && count < 1) mError = "a texture coordinate needs a number";
        mUvs.push_back({ n[0], 1 - n[1] });
    }

    void readNormal(std::string_view line) {
        std::array<float, 3> n{};
        const size_t count = readNumbers(line, n);
        if (mError.empty() && count < 3) mError = "a normal needs three numbers";
        mNormals.push_back({ n[0], n[1], n[2] });
    }

    /// "7", "7/2", "7//3", "7/2/3"; from 1, or backwards from -1.
    bool readCorner(std::string_view word, Corner& corner) {
        const std::array<std::pair<int64_t*, size_t>, 3> targets{ { { &corner.position, mPositions.size() },
                                                                    { &corner.uv, mUvs.size() },
                                                                    { &corner.normal, mNormals.size() } } };
        std::string_view rest = word;
        for (size_t i = 0; i < targets.size(); ++i) {
            const size_t slash = rest.find('/');
            const std::string_view number = rest.substr(0, slash);
            if (!number.empty() || i == 0) {
                const std::optional<int64_t> index = integerOf(number);
                const auto size = static_cast<int64_t>(targets[i].second);
                if (!index || *index == 0 || *index > size || *index < -size) {
                    mError = fmt::format("'{}' names a vertex, texture coordinate or normal that was not before",
                                         shown(word));
                    return false;
                }
                *targets[i].first = *index > 0 ? *index - 1 : size + *index;
            }
            if (slash == std::string_view::npos) return true;
            rest.remove_prefix(slash + 1);
        }
        mError = fmt::format("'{}' has more than three indices", shown(word));
        return false;
    }

    void readFace(std::string_view line) {
        mCorners.clear();
        for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line))
            if (!readCorner(word, mCorners.emplace_back())) return;
        if (mCorners.size() < 3) {
            mError = "a face needs three corners";
            return;
        }
        Part* part = currentPart();
        if (!part) return;
        mCornerPositions.clear();
        for (Corner const& corner : mCorners)
            mCornerPositions.push_back(mPositions[static_cast<size_t>(corner.position)]);
        for (std::array<uint32_t, 3> const& triangle : mTriangles.of(mCornerPositions))
            for (const uint32_t corner : triangle) part->mesh.indices.push_back(vertexOf(*part, mCorners[corner]));
    }

    uint32_t vertexOf(Part& part, Corner const& corner) {
        MeshFilePart& mesh = part.mesh;
        const auto next = static_cast<uint32_t>(mesh.positions.size());
        const auto [found, isNew] = part.vertices.try_emplace(corner, next);
        if (!isNew) return found->second;
        const auto at = [](auto const& list, int64_t index) {
            using Value = std::decay_t<decltype(list[0])>;
            return index < 0 ? Value(0.0f) : list[static_cast<size_t>(index)];
        };
        mesh.positions.push_back(mPositions[static_cast<size_t>(corner.position)]);
        mesh.uvs.push_back(at(mUvs, corner.uv));
        mesh.normals.push_back(at(mNormals, corner.normal));
        const auto place = static_cast<size_t>(corner.position);
        mesh.colors.emplace_back(place < mColors.size() ? mColors[place] : float3(1.0f), 1.0f);
        part.hasUvs = part.hasUvs && corner.uv >= 0;
        part.hasNormals = part.hasNormals && corner.normal >= 0;
        part.hasColors = part.hasColors && place < mColors.size();
        return next;
    }

    /// One of a group and a material.
    Part* currentPart() {
        if (mPart) return mPart;
        const auto [found, isNew] = mPartOf.try_emplace({ mName, mMaterial }, mParts.size());
        if (isNew) {
            if (mParts.size() == kMostParts) {
                mError = fmt::format("more than {} groups", kMostParts);
                return nullptr;
            }
            mParts.push_back({ .mesh = { .name = mName, .material = mMaterial } });
        }
        return mPart = &mParts[found->second];
    }

    void useMaterial(std::string_view name) {
        mPart = nullptr;
        for (size_t i = 0; i < mFile.materials.size(); ++i)
            if (mFile.materials[i].name == name) {
                mMaterial = static_cast<uint32_t>(i);
                return;
            }
        mDiagnostics.warn("there is no material '{}'", shown(name));
        mFile.materials.push_back({ .name = std::string(name) });
        mMaterial = static_cast<uint32_t>(mFile.materials.size() - 1);
    }

    /// `names`: one file, whose name may have blanks, or several.
    void readMaterials(std::string_view names) {
        const Result<void> all = readMaterialFile(names);
        if (all) return;
        std::string_view rest = names;
        if (takeWord(rest) == names) return mDiagnostics.warn("materials are not read: {}", all.error().message);
        rest = names;
        for (std::string_view name = takeWord(rest); !name.empty(); name = takeWord(rest))
            if (const Result<void> one = readMaterialFile(name); !one)
                mDiagnostics.warn("materials are not read: {}", one.error().message);
    }

    Result<void> readMaterialFile(std::string_view name) {
        if (!mRead) return fail(ErrorCode::NotFound, "there are no files");
        const Result<std::vector<std::byte>> bytes = mRead(std::string(name));
        if (!bytes) return bytes.error();
        readMtl({ reinterpret_cast<const char*>(bytes->data()), bytes->size() }, mFile.materials, mDiagnostics);
        return {};
    }

    void finish(Part& part) {
        if (!part.hasUvs) part.mesh.uvs.clear();
        if (!part.hasNormals) part.mesh.normals.clear();
        if (!part.hasColors) part.mesh.colors.clear();
        mFile.parts.push_back(std::move(part.mesh));
        part.vertices.clear();
    }

    ReadNeighbour const& mRead;
    Diagnostics& mDiagnostics;
    MeshFile mFile;
    std::vector<Part> mParts;
    std::map<std::pair<std::string, uint32_t>, size_t> mPartOf;
    Part* mPart = nullptr; ///< of faces that come next; null: to be found
    std::string mName;
    uint32_t mMaterial = MeshFilePart::kNoMaterial;
    std::vector<float3> mPositions, mNormals, mColors;
    std::vector<float2> mUvs;
    std::vector<Corner> mCorners;         ///< of a face
    std::vector<float3> mCornerPositions; ///< of the same
    PolygonTriangles mTriangles;
    size_t mLine = 0;
    std::string mError;
};

} // namespace

Result<MeshFile> readObj(std::string_view text, ReadNeighbour const& read, Diagnostics& diagnostics) {
    return ObjReader(read, diagnostics).read(text);
}

} // namespace filament_core::assets

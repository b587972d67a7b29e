// SPDX-License-Identifier: Apache-2.0
/// Equality of documents and their parts: field by field.
#include "tools/view/document/Fields.h"

namespace filament_core::view {
namespace {

/// All fields of a part are the same.
struct Same {
    bool operator()(Effects const& a, Effects const& b) const {
        Effects withTextureOfB = a; // Document::dirt names the image
        withTextureOfB.bloom.dirt = b.bloom.dirt;
        return withTextureOfB == b;
    }
    bool operator()(DisplayTransform const& a, DisplayTransform const& b) const {
        DisplayTransform withLookOfB = a; // Document::look names the file
        withLookOfB.look = b.look;
        return withLookOfB == b;
    }
    template <class T>
    bool operator()(std::vector<T> const& a, std::vector<T> const& b) const {
        if (a.size() != b.size()) return false;
        for (size_t i = 0; i < a.size(); ++i) {
            if (!(*this)(a[i], b[i])) return false;
        }
        return true;
    }
    template <class T>
    bool operator()(std::optional<T> const& a, std::optional<T> const& b) const {
        return a && b ? (*this)(*a, *b) : a.has_value() == b.has_value();
    }
    bool operator()(LightDesc const& a, LightDesc const& b) const {
        if (a.index() != b.index()) return false;
        return std::visit([&]<class L>(L const& light) { return (*this)(light, std::get<L>(b)); }, a);
    }
    template <class T>
    bool operator()(T const& a, T const& b) const {
        if constexpr (HasFields<T>) {
            bool isSame = true;
            forEachField<T>([&](auto const& field) { isSame = isSame && (*this)(a.*field.member, b.*field.member); });
            return isSame;
        } else if constexpr (IsUnit<T>) {
            return a.value == b.value;
        } else {
            return a == b;
        }
    }
};

} // namespace

bool operator==(DocumentModel const& a, DocumentModel const& b) { return Same()(a, b); }
bool operator==(DocumentEnvironment const& a, DocumentEnvironment const& b) { return Same()(a, b); }
bool operator==(NodeEdit const& a, NodeEdit const& b) { return Same()(a, b); }
bool operator==(MaterialEdit const& a, MaterialEdit const& b) { return Same()(a, b); }
bool operator==(TextureEdit const& a, TextureEdit const& b) { return Same()(a, b); }
bool operator==(DocumentLight const& a, DocumentLight const& b) { return Same()(a, b); }
bool operator==(DocumentProbe const& a, DocumentProbe const& b) { return Same()(a, b); }
bool operator==(DocumentGrid const& a, DocumentGrid const& b) { return Same()(a, b); }
bool operator==(ModelLightEdit const& a, ModelLightEdit const& b) { return Same()(a, b); }
bool operator==(MorphEdit const& a, MorphEdit const& b) { return Same()(a, b); }
bool operator==(Playback const& a, Playback const& b) { return Same()(a, b); }
bool operator==(Bookmark const& a, Bookmark const& b) { return Same()(a, b); }
bool operator==(CameraKey const& a, CameraKey const& b) { return Same()(a, b); }
bool operator==(CameraPath const& a, CameraPath const& b) { return Same()(a, b); }
bool operator==(Document const& a, Document const& b) { return Same()(a, b); }
bool isEqual(EnvironmentSettings const& a, EnvironmentSettings const& b) { return Same()(a, b); }
bool isEqual(Camera const& a, Camera const& b) { return Same()(a, b); }
bool isEqual(LightDesc const& a, LightDesc const& b) { return Same()(a, b); }

} // namespace filament_core::view

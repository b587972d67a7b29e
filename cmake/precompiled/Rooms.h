// SPDX-License-Identifier: Apache-2.0
/// What most files of the rooms and tools include, precompiled (FILAMENT_PCH). Headers of other projects only: they never
/// change, so that an edit of ours rebuilds no more than it would without. Every file still includes what it uses.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

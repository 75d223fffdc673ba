#pragma once
// The scenes by name.

#include "scenes/geometry.hpp"
#include "scenes/render.hpp"

namespace epiline::scenes {

/// The surfaces of a scene. Throws scene_error when there is none of that name.
[[nodiscard]] room build(std::string_view name, const scene_parameters& parameters);

}  // namespace epiline::scenes

// What an endoscope that is held as a tool sees, and the light that comes from its tip.
#pragma once

#include "render_node/camera.h"

#include <optional>

namespace omentum::render {

/// At the tip of T, along the optics' axis, upright along y of T (scope_spec.h). The target lies 10 cm ahead:
/// any distance gives the same picture.
Camera scope_camera(const Vec3& p_WT, const Eigen::Quaterniond& q_WT, const scene::ScopeSpec& scope);

/// Which of the scene's tools is the scope; none where the scene has none.
std::optional<std::size_t> scope_of(const scene::Scene& scene);

/// Half the angle of the round picture that a camera's lens lets through (lens.frag), rad.
double lens_half_angle(const Camera& camera);

/// The light of an endoscope: a ring of fibres around its lens, drawn as one point a little above it, so that
/// instruments throw the narrow shadows that tell how far they are from the tissue. It falls off with the
/// square of the distance; as a scope's camera does, the picture is exposed for what is as far away as the
/// middle of `ball`. The shadow map looks from there and ends outside of the picture.
Lighting scope_light(const Camera& camera, const Ball& ball);

}  // namespace omentum::render

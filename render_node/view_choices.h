// What a person asked to see, from the panel to the view and back.
#pragma once

#include "render_node/panel_view.h"
#include "render_node/scene_view.h"

namespace omentum::render {

struct RenderOptions;

/// At the start; the map is off.
ViewChoices first_choices(const RenderOptions& options, const scene::Scene& scene, const Camera& orbit);
/// Does to `choices` what the panel's buttons and the keys ask for; the map is the caller's, whose state it
/// changes.
void choose(const PanelActions& actions, ViewChoices& choices);
/// Tells the panel what is chosen.
void tell(const ViewChoices& choices, PanelView& panel);

}  // namespace omentum::render

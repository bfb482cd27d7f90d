#include "sinew/scene/layout.h"

#include "sinew/scene/scene.h"

namespace sinew {

Layout scene_layout() {
    return layout_of<Scene>();
}

} // namespace sinew

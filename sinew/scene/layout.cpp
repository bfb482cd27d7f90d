#include "sinew/scene/layout.h"

#include "sinew/scene/reader.h"
#include "sinew/scene/scene.h"

namespace sinew {

void detail::describe_record(AnyRecord record, Layout& shape) {
    record.each([&](void* member, const FieldType& type, const Field& field) {
        type.describe(member, field, shape.parts.emplace_back());
    });
}

Layout scene_layout() {
    return layout_of<Scene>();
}

} // namespace sinew

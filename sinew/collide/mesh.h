#pragma once

#include "sinew/collide/bounding_box.h"
#include "sinew/collide/pose.h"
#include "sinew/collide/triangle.h"
#include "sinew/math/sort.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace sinew::collide {

/// Triangles in space, solid behind each; a tree of boxes finds those near a place.
template <int D, class Real> struct Mesh {
    static_assert(D == 3);
    static constexpr std::string_view name = "mesh";
    using Vector = Vec<3, Real>;
    using Part = Triangle<Real>;

    Mesh() = default;
    Mesh(std::vector<Vector> corners, std::vector<std::array<std::uint32_t, 3>> triangles)
        : corners_(std::move(corners)), triangles_(std::move(triangles)), order_(triangles_.size()) {
        for (std::uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
        if (!order_.empty()) build(0, std::uint32_t(order_.size()));
    }

    const std::vector<Vector>& corners() const { return corners_; }
    const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return triangles_; }

    BoundingBox<3, Real> bounds(const Pose<3, Real>& pose) const {
        BoundingBox<3, Real> box;
        for (const auto& corner : corners_) box.include(pose.to_world(corner));
        return box;
    }

    template <class Visit> void parts_near(const BoundingBox<3, Real>& near, Visit&& visit) const {
        for (std::uint32_t i = 0; i < nodes_.size();) {
            const auto& node = nodes_[i];
            const bool is_near = node.box.overlaps(near);
            if (is_near && node.count > 0)
                for (std::uint32_t k = 0; k < node.count; ++k) visit(part(order_[node.first + k]));
            i = is_near ? i + 1 : node.next;
        }
    }

  private:
    /// Nodes in preorder: the children of node i begin at i + 1; `next` follows the whole subtree.
    struct Node {
        BoundingBox<3, Real> box;
        std::uint32_t first = 0, count = 0, next = 0; ///< triangles order_[first, first + count) of a leaf
    };
    std::vector<Vector> corners_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;

    Part part(std::uint32_t i) const {
        const auto& [a, b, c] = triangles_[i];
        return {corners_[a], corners_[b], corners_[c], i};
    }
    Vector sum(std::uint32_t i) const {
        const auto& [a, b, c] = triangles_[i];
        return corners_[a] + corners_[b] + corners_[c];
    }

    /// With the layer behind a triangle from which spheres are pushed out.
    void include(BoundingBox<3, Real>& box, std::uint32_t triangle) const {
        const auto side = part(triangle).b - part(triangle).a;
        for (const auto corner : triangles_[triangle])
            for (const Real depth : {share_behind<Real> * norm(side), -share_behind<Real> * norm(side)})
                box.include(corners_[corner] + Vector::map([depth](int) { return depth; }));
    }

    void build(std::uint32_t first, std::uint32_t last) {
        constexpr std::uint32_t leaf = 4;
        const auto at = nodes_.size();
        nodes_.push_back({});
        for (auto i = first; i < last; ++i) include(nodes_[at].box, order_[i]);
        if (last - first <= leaf) {
            nodes_[at].first = first, nodes_[at].count = last - first;
        } else {
            const auto middle = split(first, last, nodes_[at].box.high - nodes_[at].box.low);
            build(first, middle);
            build(middle, last);
        }
        nodes_[at].next = std::uint32_t(nodes_.size());
    }
    /// Halves the triangles along the longest axis; equal ones keep the order of their indices.
    std::uint32_t split(std::uint32_t first, std::uint32_t last, const Vector& size) {
        int axis = 0;
        for (int i = 1; i < 3; ++i)
            if (size[i] > size[axis]) axis = i;
        sinew::sort(order_.begin() + first, order_.begin() + last, [&](std::uint32_t i, std::uint32_t k) {
            const Real a = sum(i)[axis], b = sum(k)[axis];
            return a < b || (a == b && i < k);
        });
        return (first + last) / 2;
    }
};

} // namespace sinew::collide

#include "sinew/solver/step.h"

#include <algorithm>

/// Finding the trees: which distances hang together without a loop.
namespace sinew {
namespace {

template <int D, class Real> class Finder {
  public:
    explicit Finder(World<D, Real>& world)
        : particles_(world.particles), distances_(std::get<kind_number<Distance, D>>(world.constraints)),
          forest_(world.forest) {}

    void run() {
        forest_.edges.clear();
        forest_.trees.clear();
        forest_.solved.assign(distances_.size(), 0);
        find_components();
        list_edges();
        forest_.visited.assign(particles_.size(), 0);
        // a tree that hangs from something immovable is rooted there: those edges first
        for (Row edge = 0; edge < distances_.size(); ++edge)
            if (grounded(edge)) grow_from(ground_of(edge), mobile_of(edge));
        for (Row row = 0; row < particles_.size(); ++row)
            if (mobile(row)) grow_from(row, row);
        forest_.stale = false;
    }

  private:
    Particles<D, Real>& particles_;
    Constraints<Distance<D>, Real>& distances_;
    Forest<D>& forest_;

    bool mobile(Row particle) const { return particles_.mobility[particle] > Real(0); }
    Row end(Row edge, std::size_t i) const { return distances_.members.rows[edge][i]; }
    bool between_mobile(Row edge) const { return mobile(end(edge, 0)) && mobile(end(edge, 1)); }
    bool grounded(Row edge) const { return mobile(end(edge, 0)) != mobile(end(edge, 1)); }
    Row mobile_of(Row edge) const { return mobile(end(edge, 0)) ? end(edge, 0) : end(edge, 1); }
    Row ground_of(Row edge) const { return mobile(end(edge, 0)) ? end(edge, 1) : end(edge, 0); }
    /// Shares and relaxations other than the natural ones are wishes about the sweep.
    bool natural(Row edge) const {
        return distances_.split[edge] == Real(0.5) && distances_.relaxation[edge] == Real(1);
    }

    Row root_of(Row particle) {
        auto& component = forest_.component;
        while (component[particle] != particle) particle = component[particle] = component[component[particle]];
        return particle;
    }

    /// Union and find over mobile particles; an edge inside a component closes a loop.
    void find_components() {
        auto& component = forest_.component;
        component.resize(particles_.size());
        for (Row row = 0; row < component.size(); ++row) component[row] = row;
        forest_.cyclic.assign(particles_.size(), 0);
        for (Row edge = 0; edge < distances_.size(); ++edge) {
            if (!between_mobile(edge)) continue;
            const Row a = root_of(end(edge, 0)), b = root_of(end(edge, 1));
            if (a == b) forest_.cyclic[a] = 1;
            const Row low = std::min(a, b), high = std::max(a, b);
            component[high] = low;
            forest_.cyclic[low] = char(forest_.cyclic[low] | forest_.cyclic[high]);
        }
        for (Row edge = 0; edge < distances_.size(); ++edge)
            if (!natural(edge))
                for (const std::size_t i : {0U, 1U})
                    if (mobile(end(edge, i))) forest_.cyclic[root_of(end(edge, i))] = 1;
    }

    /// The edges of each particle, side by side.
    void list_edges() {
        auto& first = forest_.first_edge;
        first.assign(particles_.size() + 1, 0);
        for (Row edge = 0; edge < distances_.size(); ++edge)
            for (const std::size_t i : {0U, 1U}) ++first[end(edge, i) + 1];
        for (std::size_t row = 1; row < first.size(); ++row) first[row] += first[row - 1];
        forest_.edge_at.resize(2 * distances_.size());
        for (Row edge = Row(distances_.size()); edge-- > 0;)
            for (const std::size_t i : {0U, 1U}) forest_.edge_at[--first[end(edge, i) + 1]] = edge;
        // the countdown has moved each end to its beginning; the beginnings are one place too far right
        for (std::size_t row = 0; row + 1 < first.size(); ++row) first[row] = first[row + 1];
        first.back() = Row(forest_.edge_at.size());
    }

    /// The tree that contains `seed`, rooted at `root` (the same, or what it hangs from), breadth first; then turned
    /// round, so that children come before parents.
    void grow_from(Row root, Row seed) {
        if (forest_.visited[seed] || forest_.cyclic[root_of(seed)]) return;
        const auto begin = std::uint32_t(forest_.edges.size());
        auto& queue = forest_.queue;
        queue.clear();
        queue.push_back(root);
        if (mobile(root)) forest_.visited[root] = 1;
        for (std::size_t next = 0; next < queue.size(); ++next) {
            const Row parent = queue[next];
            if (!mobile(parent) && next > 0) continue; // another place it is fixed to
            for (Row at = forest_.first_edge[parent]; at < forest_.first_edge[parent + 1]; ++at)
                follow(forest_.edge_at[at], parent, seed, next == 0 && !mobile(root));
        }
        close(begin);
    }

    void follow(Row edge, Row parent, Row seed, bool from_ground) {
        if (forest_.solved[edge]) return;
        const Row child = end(edge, 0) == parent ? end(edge, 1) : end(edge, 0);
        if (from_ground && (child != seed || forest_.visited[child])) return; // only the edge to the seed is the root's
        if (mobile(child) && forest_.visited[child]) return;
        if (mobile(child)) forest_.visited[child] = 1;
        forest_.solved[edge] = 1;
        forest_.edges.push_back({edge, child, parent, 0});
        forest_.queue.push_back(child);
    }

    /// A tree of one edge is solved as well in the sweep, whose one step is then exact.
    void close(std::uint32_t begin) {
        const auto count = std::uint32_t(forest_.edges.size()) - begin;
        if (count < 2) {
            for (auto i = begin; i < forest_.edges.size(); ++i) forest_.solved[forest_.edges[i].constraint] = 0;
            forest_.edges.resize(begin);
            return;
        }
        // Queue entry k + 1 is the child of edge k: as nodes, edges count from the end.
        const auto first_node = begin + std::uint32_t(forest_.trees.size());
        std::uint32_t parent_entry = 0;
        for (std::uint32_t k = 0; k < count; ++k) {
            auto& edge = forest_.edges[begin + k];
            while (forest_.queue[parent_entry] != edge.parent) ++parent_entry;
            edge.parent_node = first_node + count - parent_entry;
        }
        std::reverse(forest_.edges.begin() + begin, forest_.edges.end());
        forest_.trees.push_back({begin, count, first_node});
    }
};

} // namespace

template <int D, class Real> void prepare(World<D, Real>& world) {
    auto& forest = world.forest;
    if (!forest.stale) return;
    Finder(world).run();
    // Room for all that could be, not for what is: a pin that comes or goes, or a thread that tears, must not make a
    // step allocate.
    const auto& distances = std::get<kind_number<Distance, D>>(world.constraints);
    const bool may_tear = std::any_of(distances.breaking_strain.begin(), distances.breaking_strain.end(),
                                      [](Real strain) { return strain < limit::measure<Real>; });
    const auto most = std::min(distances.size(), 2 * world.particles.size());
    constexpr std::size_t small = 100'000; // distances; of more that are all in loops, room for trees would be waste
    if (forest.trees.empty() && !may_tear && distances.size() > small) return;
    forest.edges.reserve(most);
    forest.trees.reserve(most);
    forest.queue.reserve(2 * most + 1);
    forest.resize(std::max(forest.place.size(), 2 * most));
}

#define SINEW_FOREST(D, Real) template void prepare(World<D, Real>&);
SINEW_INSTANTIATE(SINEW_FOREST)

} // namespace sinew

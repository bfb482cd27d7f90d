#pragma once

#include "sinew/solver/simd/lane_spin.h"
#include "sinew/solver/simd/link_factor.h"

#include <array>

/// Particles of a component that move as one rigid body. A body keeps the momentum and the angular momentum of its
/// particles:
///
///     motion = sum m d / sum m,   turn = I^-1 sum r x m d;     d = motion + turn x r
///
/// Lengths within a body follow; its links are no rows of the factor.
namespace sinew {
namespace {
namespace lane {

/// The arm turned by an angle, about the turn: Rodrigues' formula with half = tan(angle / 2) turn / |turn|, as a series
/// of the angle (off by angle^7 / 17000).
template <int D, int S, class V>
[[gnu::always_inline]] inline Arrow<D, V> turned(const Arrow<S, V>& turn, const Arrow<D, V>& arm) {
    const V square = dot(turn, turn);
    const auto spread_of = [](double x) { return spread<V>(x); };
    const V share = spread_of(0.5) + square * (spread_of(1.0 / 24) + square * spread_of(1.0 / 240));
    const auto half = turn * share;
    const auto across = turning(half, arm);
    return arm + (across + turning(half, across)) * (spread_of(2) / (spread_of(1) + dot(half, half)));
}

} // namespace lane

/// Clusters of the components in the lanes of V.
template <int D, class V> class LinkClusters : public LinkLanes<D, V> {
  public:
    using Lanes = LinkLanes<D, V>;
    using Fields = LinkFields<D>;
    using Lanes::Lanes, Lanes::number, Lanes::inverse_or_zero, Lanes::particle, Lanes::particle_vector;
    using Lanes::set_particle_vector, Lanes::link_vector, Lanes::set_link, Lanes::set_end, Lanes::link;
    using typename Lanes::Vector, typename Lanes::Spin;
    using Mask = decltype(V{} < V{});

    bool has_clusters() const { return pack_.clusters > 0; }

    V cluster(std::size_t i, std::size_t field) const { return Lanes::get(pack_.of_cluster(i, field)); }
    Vector cluster_vector(std::size_t i, std::size_t field) const {
        return Lanes::template get_vector<D>(pack_.of_cluster(i, field));
    }
    Spin cluster_spin(std::size_t i, std::size_t field) const {
        return Lanes::template get_vector<spins<D>>(pack_.of_cluster(i, field));
    }
    template <int N> void set_cluster(std::size_t i, std::size_t field, const lane::Arrow<N, V>& to) const {
        Lanes::put_vector(pack_.of_cluster(i, field), to);
    }
    Vector member(std::size_t i, std::size_t field) const {
        return Lanes::template get_vector<D>(pack_.of_member(i, field));
    }
    void set_member(std::size_t i, std::size_t field, const Vector& to) const {
        Lanes::put_vector(pack_.of_member(i, field), to);
    }

    /// Calls visit(member, particle) for the members of a cluster.
    template <class Visit> void each_member(std::size_t i, Visit&& visit) const {
        for (auto k = pack_.ranges[i].first; k < pack_.ranges[i].last; ++k) visit(k, pack_.particle_of[k]);
    }
    template <class Visit> void each_cluster(Visit&& visit) const {
        for (std::size_t i = 0; i < pack_.clusters; ++i) visit(i);
    }

    /// Turn of a cluster by a spin.
    Spin turn_by(std::size_t i, const Spin& spin) const {
        if constexpr (D == 2)
            return {{spin.at[0] * cluster(i, Fields::inverse_inertia)}};
        else
            return inverse_inertia(i) * spin;
    }

    // --- motions -----------------------------------------------------------------------------------------------------

    /// Motion and turn of a rigid body with the momenta of displacements of(member, particle), as its push.
    template <class Displacement>
    void gather_push(std::size_t i, std::size_t arms, const Displacement& of) const {
        Vector momentum{};
        Spin spin{};
        each_member(i, [&](std::size_t k, std::size_t p) {
            const Vector weighed = of(k, p) * particle(p, Fields::mass);
            momentum = momentum + weighed, spin = spin + moment(member(k, arms), weighed);
        });
        set_cluster(i, Fields::push, momentum * cluster(i, Fields::per_mass));
        set_cluster(i, Fields::twist, turn_by(i, spin));
    }
    void clear_pushes() const {
        each_cluster([&](std::size_t i) {
            set_cluster(i, Fields::push, Vector{});
            set_cluster(i, Fields::twist, Spin{});
        });
    }
    /// Adds an impulse on end a of a link, and its opposite on end b, to the pushes of their clusters.
    void push_ends(std::uint32_t k, const LinkRow& row, const V& size) const {
        const Vector along = link_vector(k, Fields::along);
        if (row.cluster_a != no_member)
            push(row.cluster_a, along * (size * link(k, Fields::weight_a)), Lanes::end(k, Fields::turn_a) * size);
        if (row.cluster_b != no_member)
            push(row.cluster_b, along * (-size * link(k, Fields::weight_b)), Lanes::end(k, Fields::turn_b) * -size);
    }
    /// Displacement of a member by the push on its cluster, to first order.
    Vector pushed(std::size_t i, std::size_t k, std::size_t arms) const {
        return cluster_vector(i, Fields::push) + turning(cluster_spin(i, Fields::twist), member(k, arms));
    }
    /// Makes the velocities within each cluster those of a rigid body.
    void hold_velocities(const Mask& mask) const {
        each_cluster([&](std::size_t i) {
            gather_push(i, Fields::now, [&](std::size_t, std::size_t p) { return displacement(p); });
            each_member(i, [&](std::size_t k, std::size_t p) {
                set_particle_vector(p, Fields::displacement, blend(mask, pushed(i, k, Fields::now), displacement(p)));
            });
        });
    }
    /// Adds the pushes to the velocities.
    void add_pushes() const {
        each_cluster([&](std::size_t i) {
            each_member(i, [&](std::size_t k, std::size_t p) {
                set_particle_vector(p, Fields::displacement, displacement(p) + pushed(i, k, Fields::now));
            });
        });
    }

    // --- shapes ------------------------------------------------------------------------------------------------------

    /// Masses, and the shapes turned as the particles lie, at places(particle).
    template <class Place> void begin_shapes(const Place& place) const {
        each_cluster([&](std::size_t i) {
            V mass{};
            each_member(i, [&](std::size_t, std::size_t p) { mass = mass + particle(p, Fields::mass); });
            Lanes::put(pack_.of_cluster(i, Fields::per_mass), inverse_or_zero(mass));
            guess_turn(i, place);
            center_shape(i);
            weigh(i);
        });
        fit(place, 5);
    }
    /// Turns the shapes from the last places to places(particle).
    template <class Place> void fit(const Place& place, int rounds) const {
        each_cluster([&](std::size_t i) {
            const Vector center = center_of(i, place);
            for (int n = 0; n < rounds; ++n) {
                Spin spin{};
                each_member(i, [&](std::size_t k, std::size_t p) {
                    const Vector arm = member(k, Fields::now);
                    spin = spin + moment(arm, (place(p) - center - arm) * particle(p, Fields::mass));
                });
                const Spin turn = turn_by(i, spin);
                each_member(i, [&](std::size_t k, std::size_t) {
                    set_member(k, Fields::now, turned(turn, member(k, Fields::now)));
                });
            }
            each_member(i, [&](std::size_t k, std::size_t p) {
                set_member(k, Fields::off, center + member(k, Fields::now) - place(p));
                set_member(k, Fields::end, member(k, Fields::now));
            });
            weigh(i);
        });
    }

    // --- places ------------------------------------------------------------------------------------------------------

    /// Displacement of a member that keeps the shape, by the motion and the turn of its cluster.
    Vector placed(std::size_t i, std::size_t k) const {
        return cluster_vector(i, Fields::motion) + member(k, Fields::off) +
               (member(k, Fields::end) - member(k, Fields::now));
    }
    /// Before lengths are corrected: takes up the displacements, or, `again`, what has been added since the last time
    /// in the masked lanes.
    void begin_places(bool again, const Mask& mask) const {
        each_cluster([&](std::size_t i) {
            if (again) {
                gather_push(i, Fields::end,
                            [&](std::size_t k, std::size_t p) { return displacement(p) - placed(i, k); });
                return move_cluster(i, mask ? number(1) : V{});
            }
            gather_push(i, Fields::now, [&](std::size_t, std::size_t p) { return displacement(p); });
            set_cluster(i, Fields::motion, Vector{});
            set_cluster(i, Fields::turn, Spin{});
            move_cluster(i, number(1));
        });
    }
    /// Moves the clusters by a share of their pushes, on arcs.
    void move_clusters(const V& share) const {
        each_cluster([&](std::size_t i) { move_cluster(i, share); });
    }
    /// Keeps the spins, for the velocities at the end.
    void end_places() const {
        each_cluster([&](std::size_t i) {
            const Spin turn = cluster_spin(i, Fields::turn);
            Spin spin{};
            each_member(i, [&](std::size_t k, std::size_t p) {
                const Vector arm = member(k, Fields::now);
                spin = spin + moment(arm, turning(turn, arm) * particle(p, Fields::mass));
            });
            set_cluster(i, Fields::spin, spin);
        });
    }
    /// Once the particles have moved: velocities that keep the momenta, in place of the ways on arcs. What else has
    /// been added to the displacements stays.
    void end_arcs() const {
        each_cluster([&](std::size_t i) {
            each_member(i, [&](std::size_t k, std::size_t p) {
                set_particle_vector(p, Fields::displacement, displacement(p) - placed(i, k));
                set_member(k, Fields::now, member(k, Fields::end));
            });
            weigh(i);
            const Vector motion = cluster_vector(i, Fields::motion);
            const Spin turn = turn_by(i, cluster_spin(i, Fields::spin));
            each_member(i, [&](std::size_t k, std::size_t p) {
                set_particle_vector(p, Fields::displacement,
                                    displacement(p) + (motion + turning(turn, member(k, Fields::now))));
            });
        });
    }

    // --- links -------------------------------------------------------------------------------------------------------

    /// Mobilities of a link's ends in the masked lanes, and their moments about the centres; `arms`: `now`, or `end`.
    void weigh_ends(std::uint32_t k, const LinkRow& row, std::size_t arms, const Mask& mask) const {
        if (row.cluster_a != no_member)
            weigh_end(k, row.cluster_a, row.member_a, arms, mask, {Fields::weight_a, Fields::arm_a, Fields::turn_a});
        if (row.cluster_b != no_member)
            weigh_end(k, row.cluster_b, row.member_b, arms, mask, {Fields::weight_b, Fields::arm_b, Fields::turn_b});
    }

    /// Lanes in which an arm of a link has turned by more since the ends were weighed.
    Mask arms_turned(std::uint32_t k, const LinkRow& row, double slightly) const {
        const auto off = [&](std::uint32_t in, std::uint32_t member_of, std::size_t field) {
            if (in == no_member) return V{};
            const Vector arm = member(member_of, Fields::now);
            const Spin change = moment(arm, link_vector(k, Fields::along)) - Lanes::end(k, field);
            return V(dot(change, change) - dot(arm, arm) * number(slightly * slightly));
        };
        return lane::max(off(row.cluster_a, row.member_a, Fields::arm_a),
                         off(row.cluster_b, row.member_b, Fields::arm_b)) > V{};
    }

  protected:
    using Lanes::pack_;
    Vector displacement(std::size_t p) const { return particle_vector(p, Fields::displacement); }

    template <int N>
    static lane::Arrow<N, V> blend(const Mask& mask, const lane::Arrow<N, V>& a, const lane::Arrow<N, V>& b) {
        lane::Arrow<N, V> v;
        for (int k = 0; k < N; ++k) v.at[k] = mask ? a.at[k] : b.at[k];
        return v;
    }

  private:
    struct EndFields {
        std::size_t weight, arm, turn;
    };
    void weigh_end(std::uint32_t k, std::uint32_t cluster_of, std::uint32_t member_of, std::size_t arms,
                   const Mask& mask, const EndFields& fields) const {
        const Spin arm =
            blend(mask, moment(member(member_of, arms), link_vector(k, Fields::along)), Lanes::end(k, fields.arm));
        set_link(k, fields.weight, cluster(cluster_of, Fields::per_mass));
        set_end(k, fields.arm, arm);
        set_end(k, fields.turn, blend(mask, turn_by(cluster_of, arm), Lanes::end(k, fields.turn)));
    }
    void move_cluster(std::size_t i, const V& share) const {
        const Spin turn = cluster_spin(i, Fields::turn) + cluster_spin(i, Fields::twist) * share;
        set_cluster(i, Fields::turn, turn);
        set_cluster(i, Fields::motion, cluster_vector(i, Fields::motion) + cluster_vector(i, Fields::push) * share);
        each_member(i, [&](std::size_t k, std::size_t p) {
            set_member(k, Fields::end, turned(turn, member(k, Fields::now)));
            set_particle_vector(p, Fields::displacement, placed(i, k));
        });
    }
    lane::Square<D, V> inverse_inertia(std::size_t i) const {
        lane::Square<D, V> m;
        for (std::size_t k = 0; k < std::size_t(D * D); ++k)
            m.at[k] = cluster(i, Fields::inverse_inertia + k);
        return m;
    }
  protected:
    void push(std::size_t i, const Vector& by, const Spin& turn) const {
        set_cluster(i, Fields::push, cluster_vector(i, Fields::push) + by);
        set_cluster(i, Fields::twist, cluster_spin(i, Fields::twist) + turn);
    }

  private:
    /// Inverse inertia of the shape as it lies now.
    void weigh(std::size_t i) const {
        if constexpr (D == 2) {
            V inertia{};
            each_member(i, [&](std::size_t k, std::size_t p) {
                const Vector arm = member(k, Fields::now);
                inertia = inertia + dot(arm, arm) * particle(p, Fields::mass);
            });
            Lanes::put(pack_.of_cluster(i, Fields::inverse_inertia), inverse_or_zero(inertia));
        } else {
            lane::Square<D, V> inertia{};
            each_member(i, [&](std::size_t k, std::size_t p) {
                const Vector arm = member(k, Fields::now);
                const V mass = particle(p, Fields::mass);
                inertia.add_to_diagonal(dot(arm, arm) * mass);
                const auto product = outer(arm, arm) * -mass;
                for (int n = 0; n < D * D; ++n) inertia.at[n] = inertia.at[n] + product.at[n];
            });
            V determinant;
            const auto all = lane::adjugate(inertia, determinant);
            const V per = inverse_or_zero(determinant);
            for (std::size_t n = 0; n < std::size_t(D * D); ++n)
                Lanes::put(pack_.of_cluster(i, Fields::inverse_inertia + n), V(all.at[n] * per));
        }
    }
    template <class Place> Vector center_of(std::size_t i, const Place& place) const {
        Vector sum{};
        each_member(i, [&](std::size_t, std::size_t p) { sum = sum + place(p) * particle(p, Fields::mass); });
        return sum * cluster(i, Fields::per_mass);
    }
    void center_shape(std::size_t i) const {
        Vector sum{};
        each_member(i, [&](std::size_t k, std::size_t p) {
            sum = sum + member(k, Fields::now) * particle(p, Fields::mass);
        });
        const Vector center = sum * cluster(i, Fields::per_mass);
        each_member(i, [&](std::size_t k, std::size_t) {
            set_member(k, Fields::now, member(k, Fields::now) - center);
        });
    }
    static Vector direction(const Vector& v) { return v * inverse_or_zero(lane::root(V(dot(v, v)))); }

    /// The shape at rest, turned as the first three members lie; in 2D as all do.
    template <class Place> void guess_turn(std::size_t i, const Place& place) const {
        if constexpr (D == 2) {
            const Vector center = center_of(i, place);
            V along{}, across{};
            each_member(i, [&](std::size_t k, std::size_t p) {
                const Vector rest = member(k, Fields::rest), arm = (place(p) - center) * particle(p, Fields::mass);
                along = along + dot(rest, arm), across = across + moment(rest, arm).at[0];
            });
            const Vector turn = direction({{along, across}});
            each_member(i, [&](std::size_t k, std::size_t) {
                const Vector rest = member(k, Fields::rest);
                set_member(k, Fields::now, {{turn.at[0] * rest.at[0] - turn.at[1] * rest.at[1],
                                             turn.at[1] * rest.at[0] + turn.at[0] * rest.at[1]}});
            });
        } else {
            const auto first = pack_.ranges[i].first;
            const auto axes = [&](const Vector& a, const Vector& b, const Vector& c) {
                const Vector x = direction(b - a), z = direction(cross(x, c - a));
                return std::array<Vector, 3>{x, cross(z, x), z};
            };
            const auto& p = pack_.particle_of;
            const auto from = axes(member(first, Fields::rest), member(first + 1, Fields::rest),
                                   member(first + 2, Fields::rest));
            const auto to = axes(place(p[first]), place(p[first + 1]), place(p[first + 2]));
            each_member(i, [&](std::size_t k, std::size_t) {
                const Vector rest = member(k, Fields::rest);
                Vector now{};
                for (std::size_t n = 0; n < 3; ++n) now = now + to[n] * V(dot(from[n], rest));
                set_member(k, Fields::now, now);
            });
        }
    }
};

} // namespace
} // namespace sinew

#pragma once

#include "sinew/solver/simd/link_factor.h"

namespace sinew {
namespace {

/// Rigid clusters of the components in the lanes of V: particles whose links leave them no motion but that of a body.
/// Their links need no factor. With M the mass, a the arms from the centre of mass and J the inertia,
///
///     move = sum m d / M,  turn = J^-1 sum m a x d,  d = move + turn x a              velocities
///     sum m a x Q a = J turn                                                          the rotation Q of a substep
///
/// The second is RATTLE's: linear and angular momentum stay. In the plane its solution is sin(angle) = turn; in 3D it
/// is the discrete equation of Moser and Veselov (1991).
template <int D, class V> class LinkClusters : protected LinkLanes<D, V> {
  public:
    using Lanes = LinkLanes<D, V>;
    using Fields = LinkFields<D>;
    using typename Lanes::Spin, typename Lanes::Vector;
    using Matrix = lane::Square<D, V>;
    using Inertia = lane::Square<Lanes::spins, V>;
    using typename Lanes::Mask;

  protected:
    using Lanes::cluster, Lanes::set_cluster, Lanes::cluster_vector, Lanes::set_cluster_vector;
    using Lanes::cluster_spin, Lanes::set_cluster_spin, Lanes::particle_vector, Lanes::set_particle_vector;
    using Lanes::Lanes, Lanes::number, Lanes::inverse_or_zero, Lanes::pack_, Lanes::particle, Lanes::set_particle;
    using Lanes::link, Lanes::link_vector, Lanes::link_spin, Lanes::set_link_spin;
    static constexpr std::uint32_t none = LinkRow::none;

    template <int N>
    static lane::Arrow<N, V> blend(const Mask& mask, const lane::Arrow<N, V>& a, const lane::Arrow<N, V>& b) {
        lane::Arrow<N, V> v;
        for (int k = 0; k < N; ++k) v.at[k] = mask ? a.at[k] : b.at[k];
        return v;
    }
    static V norm(const Vector& v) { return lane::root(dot(v, v)); }
    static Spin moment(const Vector& arm, const Vector& push) {
        if constexpr (D == 2)
            return {{arm.at[0] * push.at[1] - arm.at[1] * push.at[0]}};
        else
            return cross(arm, push);
    }
    /// turn x arm
    static Vector swept(const Spin& turn, const Vector& arm) {
        if constexpr (D == 2)
            return {{-turn.at[0] * arm.at[1], turn.at[0] * arm.at[0]}};
        else
            return cross(turn, arm);
    }

    template <class Visit> void each_cluster(Visit&& visit) const {
        for (std::uint32_t c = 0; c < pack_.clusters; ++c) visit(c);
    }
    template <class Visit> void each_member(std::uint32_t c, Visit&& visit) const {
        for (auto i = pack_.cluster[c].first; i < pack_.cluster[c].last; ++i) visit(pack_.members[i]);
    }
    template <class Of> auto sum_over(std::uint32_t c, const Of& of) const {
        decltype(of(pack_.members[0])) sum{};
        each_member(c, [&](std::uint32_t i) { sum = sum + of(i); });
        return sum;
    }
    Inertia inertia(std::uint32_t c, std::size_t field) const {
        Inertia m;
        for (std::size_t k = 0; k < Fields::inertias; ++k) m.at[k] = cluster(c, field + k);
        return m;
    }
    template <class M> void set_matrix(std::uint32_t c, std::size_t field, const M& to) const {
        for (std::size_t k = 0; k < sizeof(to.at) / sizeof(V); ++k) set_cluster(c, field + k, to.at[k]);
    }

    // --- pose --------------------------------------------------------------------------------------------------------

    /// Centres of mass in the frames of the clusters.
    [[gnu::flatten, gnu::noinline]] void find_centres() const {
        each_cluster([&](std::uint32_t c) {
            const V per_mass = inverse_or_zero(sum_over(c, [&](std::uint32_t i) { return particle(i, Fields::mass); }));
            set_cluster(c, Fields::per_mass, per_mass);
            const auto place = [&](std::uint32_t i) {
                return particle_vector(i, Fields::rest) * particle(i, Fields::mass);
            };
            set_cluster_vector(c, Fields::centre, sum_over(c, place) * per_mass);
        });
    }
    /// Poses nearest to the positions that `at(particle)` returns, in the metric of the masses.
    template <class At> void find_poses(const At& at) const {
        each_cluster([&](std::uint32_t c) {
            const auto weighted = [&](std::uint32_t i) { return at(i) * particle(i, Fields::mass); };
            const Vector middle = sum_over(c, weighted) * cluster(c, Fields::per_mass);
            each_member(c, [&](std::uint32_t i) { set_particle_vector(i, Fields::off, middle - at(i)); });
            const Matrix rotation = rotation_of(c);
            set_matrix(c, Fields::rotation, rotation);
            take_arms(c, rotation);
            each_member(c, [&](std::uint32_t i) {
                set_particle_vector(i, Fields::off, particle_vector(i, Fields::off) + particle_vector(i, Fields::arm));
            });
            const Inertia own = inertia_of(c);
            set_matrix(c, Fields::inertia, own);
            set_matrix(c, Fields::per_inertia, inverse(own));
        });
    }
    /// Factors at the present directions and poses.
    void factorise(const Mask& mask) const {
        for (std::uint32_t k = 0; k < pack_.links; ++k)
            Lanes::set_link_vector(k, Fields::factored,
                                   blend(mask, link_vector(k, Fields::along), link_vector(k, Fields::factored)));
        take_rotations(mask);
        Lanes::factorise(mask);
    }
    /// Lanes in which a cluster has turned by more than an angle since its factorisation.
    Mask have_turned(const V& angle) const {
        V most{};
        each_cluster([&](std::uint32_t c) {
            V sum{};
            for (std::size_t k = 0; k < D * D; ++k) {
                const V off = cluster(c, Fields::rotation + k) - cluster(c, Fields::taken + k);
                sum = sum + off * off;
            }
            most = lane::max(most, sum);
        });
        return angle * angle * number(2) < most;
    }
    void take_rotations(const Mask& mask) const {
        each_cluster([&](std::uint32_t c) {
            for (std::size_t k = 0; k < D * D; ++k)
                set_cluster(c, Fields::taken + k,
                            mask ? cluster(c, Fields::rotation + k) : cluster(c, Fields::taken + k));
        });
    }

    /// Levers of a link in its direction, in the present poses, or in those at the end of the displacements.
    void take_levers(std::uint32_t k, const LinkRow& row, const Mask& mask, bool at_end = false) const {
        const auto take = [&](std::uint32_t i, std::uint32_t c, std::size_t lever, std::size_t turned) {
            if (c == none) return;
            Vector arm = particle_vector(i, Fields::arm);
            if (at_end)
                arm = arm + particle_vector(i, Fields::displacement) - particle_vector(i, Fields::off) -
                      cluster_vector(c, Fields::move);
            const Spin own = moment(arm, link_vector(k, Fields::along));
            set_link_spin(k, lever, blend(mask, own, link_spin(k, lever)));
            set_link_spin(k, turned, blend(mask, inertia(c, Fields::per_inertia) * own, link_spin(k, turned)));
        };
        take(row.a, row.cluster_a, Fields::lever_a, Fields::turned_a);
        take(row.b, row.cluster_b, Fields::lever_b, Fields::turned_b);
    }

    // --- motion ------------------------------------------------------------------------------------------------------

    /// Velocities of bodies; keeps in `held` the changes of the particles' own.
    [[gnu::flatten, gnu::noinline]] void make_rigid(const Mask& mask) const {
        find_moves();
        each_cluster([&](std::uint32_t c) {
            const auto angular = [&](std::uint32_t i) { return moment(particle_vector(i, Fields::arm), momentum(i)); };
            set_cluster_spin(c, Fields::turn, inertia(c, Fields::per_inertia) * sum_over(c, angular));
        });
        spread(mask, Fields::move, Fields::turn);
    }
    /// Mean displacements.
    void find_moves() const {
        each_cluster([&](std::uint32_t c) {
            const auto own = [&](std::uint32_t i) { return momentum(i); };
            set_cluster_vector(c, Fields::move, sum_over(c, own) * cluster(c, Fields::per_mass));
        });
    }
    /// Displacements of the members by the motion of their clusters.
    [[gnu::flatten, gnu::noinline]] void spread(const Mask& mask, std::size_t move, std::size_t turn) const {
        each_cluster([&](std::uint32_t c) {
            const Vector moved = cluster_vector(c, move);
            const Spin turned = cluster_spin(c, turn);
            each_member(
                c, [&](std::uint32_t i) { place(mask, i, moved + swept(turned, particle_vector(i, Fields::arm))); });
        });
    }
    /// Displacements of the members to the poses at the end of the substep.
    [[gnu::flatten, gnu::noinline]] void pose(const Mask& mask) const {
        each_cluster([&](std::uint32_t c) {
            const Vector moved = cluster_vector(c, Fields::move);
            const auto turned = rotation_by(c);
            each_member(c, [&](std::uint32_t i) {
                place(mask, i, particle_vector(i, Fields::off) + moved + turned(particle_vector(i, Fields::arm)));
            });
        });
    }

    // --- links between clusters --------------------------------------------------------------------------------------

    /// Change of a link to first order.
    [[gnu::always_inline]] V rate(std::uint32_t k, const LinkRow& row, std::size_t displacement = Fields::displacement,
                                  std::size_t move = Fields::move, std::size_t turn = Fields::turn) const {
        V levers{};
        const auto end = [&](std::uint32_t i, std::uint32_t c, std::size_t lever, const V& sign) {
            if (c == none) return particle_vector(i, displacement);
            levers = levers + sign * dot(link_spin(k, lever), cluster_spin(c, turn));
            return cluster_vector(c, move);
        };
        const Vector a = end(row.a, row.cluster_a, Fields::lever_a, number(-1));
        const Vector b = end(row.b, row.cluster_b, Fields::lever_b, number(1));
        return dot(link_vector(k, Fields::along), b - a) + levers;
    }
    /// Adds the displacements for a pull of a link to those fields.
    [[gnu::always_inline]] void pull(std::uint32_t k, const LinkRow& row, const V& strength, std::size_t displacement,
                                     std::size_t move, std::size_t turn) const {
        const Vector along = link_vector(k, Fields::along);
        const auto end = [&](std::uint32_t i, std::uint32_t c, std::size_t weight, std::size_t turned, const V& by) {
            const Vector push = along * (by * link(k, weight));
            if (c == none) return set_particle_vector(i, displacement, particle_vector(i, displacement) + push);
            set_cluster_vector(c, move, cluster_vector(c, move) + push);
            set_cluster_spin(c, turn, cluster_spin(c, turn) + link_spin(k, turned) * by);
        };
        end(row.a, row.cluster_a, Fields::weight_a, Fields::turned_a, strength);
        end(row.b, row.cluster_b, Fields::weight_b, Fields::turned_b, -strength);
    }
    [[gnu::flatten, gnu::noinline]] void clear_added() const {
        for (std::size_t i = 0; i < pack_.particles; ++i) set_particle_vector(i, Fields::added, Vector{});
        each_cluster([&](std::uint32_t c) {
            set_cluster_vector(c, Fields::added_move, Vector{}), set_cluster_spin(c, Fields::added_turn, Spin{});
        });
    }
    Vector added_at(std::uint32_t i, std::uint32_t c) const {
        return cluster_vector(c, Fields::added_move) +
               swept(cluster_spin(c, Fields::added_turn), particle_vector(i, Fields::arm));
    }
    /// Moves the clusters by a share of the added motion.
    [[gnu::flatten, gnu::noinline]] void add(const V& share) const {
        each_cluster([&](std::uint32_t c) {
            set_cluster_vector(c, Fields::move,
                               cluster_vector(c, Fields::move) + cluster_vector(c, Fields::added_move) * share);
            set_cluster_spin(c, Fields::turn,
                             cluster_spin(c, Fields::turn) + cluster_spin(c, Fields::added_turn) * share);
        });
    }
    /// The pull of a link on members of clusters is no displacement by the links of these.
    void note_pull(std::uint32_t k, const LinkRow& row, const V& strength) const {
        if (!pack_.notes_held) return;
        const Vector along = link_vector(k, Fields::along);
        const auto end = [&](std::uint32_t i, std::uint32_t c, const V& by) {
            if (c == none) return;
            set_particle_vector(i, Fields::held,
                                particle_vector(i, Fields::held) - along * (by * particle(i, Fields::mobility)));
        };
        end(row.a, row.cluster_a, strength), end(row.b, row.cluster_b, -strength);
    }

    /// Adds the displacement for a push on a particle.
    void push(std::uint32_t i, const Vector& by) const {
        const auto c = cluster_of(i);
        if (c == none) {
            const Vector moved = by * particle(i, Fields::mobility);
            return set_particle_vector(i, Fields::added, particle_vector(i, Fields::added) + moved);
        }
        set_cluster_vector(c, Fields::added_move,
                           cluster_vector(c, Fields::added_move) + by * cluster(c, Fields::per_mass));
        const Spin turned = inertia(c, Fields::per_inertia) * moment(particle_vector(i, Fields::arm), by);
        set_cluster_spin(c, Fields::added_turn, cluster_spin(c, Fields::added_turn) + turned);
    }
    void spread_added() const {
        each_cluster([&](std::uint32_t c) {
            each_member(c, [&](std::uint32_t i) { set_particle_vector(i, Fields::added, added_at(i, c)); });
        });
    }

  private:
    std::uint32_t cluster_of(std::uint32_t member) const {
        for (std::uint32_t c = 0; c < pack_.clusters; ++c)
            for (auto i = pack_.cluster[c].first; i < pack_.cluster[c].last; ++i)
                if (pack_.members[i] == member) return c;
        return none;
    }
    Vector momentum(std::uint32_t i) const {
        return particle_vector(i, Fields::displacement) * particle(i, Fields::mass);
    }
    [[gnu::always_inline]] void place(const Mask& mask, std::uint32_t i, const Vector& to) const {
        const Vector from = particle_vector(i, Fields::displacement);
        const Vector there = blend(mask, to, from);
        set_particle_vector(i, Fields::displacement, there);
        if (pack_.notes_held) set_particle_vector(i, Fields::held, particle_vector(i, Fields::held) + (there - from));
    }
    Vector rest_arm(std::uint32_t i, std::uint32_t c) const {
        return particle_vector(i, Fields::rest) - cluster_vector(c, Fields::centre);
    }
    void take_arms(std::uint32_t c, const Matrix& rotation) const {
        each_member(c, [&](std::uint32_t i) { set_particle_vector(i, Fields::arm, rotation * rest_arm(i, c)); });
    }
    Inertia inertia_of(std::uint32_t c) const {
        const auto own = [&](std::uint32_t i) {
            const Vector arm = particle_vector(i, Fields::arm);
            const V mass = particle(i, Fields::mass), square = dot(arm, arm);
            Wrapped sum;
            if constexpr (D == 2) {
                sum.m.at[0] = square * mass;
            } else {
                sum.m = outer(arm, arm) * -mass;
                sum.m.add_to_diagonal(square * mass);
            }
            return sum;
        };
        return sum_over(c, own).m;
    }
    /// Sum of matrices.
    struct Wrapped {
        Inertia m{};
        friend Wrapped operator+(Wrapped a, const Wrapped& b) {
            for (std::size_t k = 0; k < Fields::inertias; ++k) a.m.at[k] = a.m.at[k] + b.m.at[k];
            return a;
        }
    };
    static Inertia inverse(const Inertia& m) {
        if constexpr (D == 2) {
            return {{inverse_or_zero(m.at[0])}};
        } else {
            V determinant;
            const Inertia scaled = adjugate(m, determinant);
            return scaled * inverse_or_zero(determinant);
        }
    }

    /// Rotation of a frame whose members are at -off.
    Matrix rotation_of(std::uint32_t c) const {
        if constexpr (D == 2) {
            V along{}, across{};
            each_member(c, [&](std::uint32_t i) {
                const Vector rest = rest_arm(i, c) * particle(i, Fields::mass), off = particle_vector(i, Fields::off);
                along = along - dot(rest, off), across = across - moment(rest, off).at[0];
            });
            const V size = lane::root(along * along + across * across), per_size = inverse_or_zero(size);
            const V cosine = size > V{} ? along * per_size : number(1), sine = across * per_size;
            return {{cosine, -sine, sine, cosine}};
        } else {
            Matrix rotation = frame_of(c);
            for (int i = 0; i < 2; ++i) {
                take_arms(c, rotation);
                const auto torque = [&](std::uint32_t m) {
                    return moment(particle_vector(m, Fields::off), particle_vector(m, Fields::arm)) *
                           particle(m, Fields::mass);
                };
                rotation = turned_by(inverse(inertia_of(c)) * sum_over(c, torque) * number(0.5), rotation);
            }
            return rotation;
        }
    }
    /// Frame of the first three members: origin, along the first axis, in the plane of the first two.
    Matrix frame_of(std::uint32_t c) const {
        const auto* const members = pack_.members + pack_.cluster[c].first;
        const auto from_first = [&](std::size_t i) {
            return particle_vector(members[0], Fields::off) - particle_vector(members[i], Fields::off);
        };
        const auto unit = [](const Vector& v) { return v * inverse_or_zero(norm(v)); };
        const Vector x = unit(from_first(1)), z = unit(cross(x, from_first(2))), y = cross(z, x);
        return {{x.at[0], y.at[0], z.at[0], x.at[1], y.at[1], z.at[1], x.at[2], y.at[2], z.at[2]}};
    }
    /// The rotation after another one, of tangent b of half the angle (Cayley).
    static Matrix turned_by(const Vector& b, const Matrix& rotation) {
        const V share = number(2) / (number(1) + dot(b, b));
        Matrix turned;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector v{{rotation.at[k], rotation.at[3 + k], rotation.at[6 + k]}};
            const Vector once = cross(b, v), moved = v + (once + cross(b, once)) * share;
            turned.at[k] = moved.at[0], turned.at[3 + k] = moved.at[1], turned.at[6 + k] = moved.at[2];
        }
        return turned;
    }

    /// Function arm -> Q arm - arm for the turn of a cluster.
    auto rotation_by(std::uint32_t c) const {
        constexpr double furthest = 0.9; // sine in the plane
        const Spin turn = cluster_spin(c, Fields::turn);
        if constexpr (D == 2) {
            const V sine = lane::min(lane::max(turn.at[0], number(-furthest)), number(furthest));
            const V less = sine * sine / (number(1) + lane::root(number(1) - sine * sine)); // 1 - cosine
            return [sine, less](const Vector& arm) {
                return Vector{{-less * arm.at[0] - sine * arm.at[1], sine * arm.at[0] - less * arm.at[1]}};
            };
        } else {
            constexpr int rounds = 6;
            constexpr double most = 0.6; // sine of half the angle
            const Inertia own = inertia(c, Fields::inertia), per = inertia(c, Fields::per_inertia);
            const Spin half = turn * number(0.5), momentum = own * half;
            Spin b = within(half, most);
            for (int i = 0; i < rounds; ++i)
                b = within(per * (momentum - cross(b, own * b)) * inverse_or_zero(cosine_of(b)), most);
            return [b, cosine = cosine_of(b)](const Vector& arm) {
                const Vector once = cross(b, arm);
                return (once * cosine + cross(b, once)) * number(2);
            };
        }
    }
    static Spin within(const Spin& b, double most) {
        const V size = lane::root(dot(b, b));
        const V share = size > number(most) ? number(most) / size : number(1);
        return b * share;
    }
    static V cosine_of(const Spin& sine) { return lane::root(number(1) - dot(sine, sine)); }
};

} // namespace
} // namespace sinew

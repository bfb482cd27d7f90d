#include "sinew/solver/cloth/thin_contact.h"

#include "sinew/solver/cloth/near_pairs.h"
#include "sinew/solver/cloth/thin_motion.h"
#include "sinew/solver/cloth/truncation.h"
#include "sinew/solver/layer_correction.h"

namespace sinew::detail {
namespace {

template <class Real> class ThinContact {
  public:
    ThinContact(const World<3, Real>& world, SweepState<3, Real>& state, ThinRoom<3, Real>& room,
                const SubstepSpan<Real>& span)
        : world_(world), room_(room), span_(span), motion_(world, state, room, span),
          near_(room, span.number, span.count) {}

    void solve() {
        motion_.read();
        if (span_.number == 1) motion_.begin_step();
        keep_list();
        near_.look_at_all();
        for (auto& pairs : room_.pairs) near_.list_touching(pairs);
        for (auto& pairs : room_.pairs)
            for (const auto i : pairs.touching) part(pairs.near[i]);
        motion_.write();
    }

    /// Vertices held back are off their forecast, and may be met by others: pairs are looked at again.
    void truncate() {
        motion_.read_displacements();
        Truncation<Real> truncation(room_);
        for (bool again = true; again;) {
            if (!room_.is_calm)
                look_again();
            else if (motion_.largest() > room_.skin)
                look_at_all_ahead();
            again = truncation.separate_all();
            if (again) motion_.look_ahead();
        }
        motion_.write();
    }

  private:
    const World<3, Real>& world_;
    ThinRoom<3, Real>& room_;
    SubstepSpan<Real> span_;
    ThinMotion<Real> motion_;
    NearPairs<Real> near_;

    /// In a calm step a list of an earlier step serves, renewed for the few vertices that have travelled: any such list
    /// has the same pairs that touch. In others all follows from the beginning of the step.
    void keep_list() {
        FeatureSearch<Real> search(world_, room_, span_.number);
        const bool was_calm = room_.is_calm;
        room_.is_calm = was_calm && motion_.is_within_skin();
        if (room_.is_calm && !(room_.is_listed && room_.is_static))
            search.list(true, span_.number);
        else if (!room_.is_calm && (was_calm || span_.number == 1 || span_.number > room_.last_substep))
            search.list(false, horizon());
        search.renew();
    }
    /// Last substep of a list that looks ahead: so far ahead that vertices move by a few skins relative to each other.
    /// A longer list has more pairs, and more vertices that leave it; a shorter one is soon made again.
    int horizon() const {
        constexpr Real skins = 4;
        constexpr int min_substeps = 3;
        const Real substeps = min(skins * room_.skin, Real(span_.count) * motion_.typical()) / motion_.typical();
        return std::min(span_.count, span_.number - 1 + std::max(min_substeps, int(substeps)));
    }
    void look_again() {
        FeatureSearch<Real>(world_, room_, span_.number).renew();
        near_.look_again();
    }
    /// Calm displacements cannot bring together distant pairs: after others all are looked at anew.
    void look_at_all_ahead() {
        room_.is_calm = false;
        FeatureSearch<Real> search(world_, room_, span_.number);
        search.list(false, horizon());
        search.renew();
        near_.look_at_all();
    }

    /// Moves a pair apart that would come nearer than its thickness.
    void part(const NearPair<Real>& pair) {
        const auto moved = relative_displacement(room_, pair);
        const Real overlap = pair.thickness - pair.distance - dot(pair.normal, moved);
        Real mobility = 0;
        for (std::size_t i = 0; i < 4; ++i)
            mobility += square(pair.weight[i]) * room_.vertices[pair.vertex[i]].mobility;
        if (!(overlap > Real(0)) || mobility == Real(0)) return;
        const Real friction = min(room_.mesh.friction[pair.vertex[0]], room_.mesh.friction[pair.vertex[3]]);
        const auto change = layer_correction(pair.normal, moved, overlap, friction) * inverse_or_zero(mobility);
        for (std::size_t i = 0; i < 4; ++i) {
            auto& vertex = room_.vertices[pair.vertex[i]];
            vertex.displacement += change * (pair.weight[i] * vertex.mobility);
        }
    }
};

} // namespace

template <int D, class Real>
void part_thin_cloth(const World<D, Real>& world, SweepState<D, Real>& state, ThinRoom<D, Real>& room,
                     const SubstepSpan<Real>& span) {
    if constexpr (D == 3) ThinContact<Real>(world, state, room, span).solve();
}
template <int D, class Real>
void truncate_thin_cloth(const World<D, Real>& world, SweepState<D, Real>& state, ThinRoom<D, Real>& room,
                         const SubstepSpan<Real>& span) {
    if constexpr (D == 3) ThinContact<Real>(world, state, room, span).truncate();
}

#define SINEW_THIN_CONTACT(D, Real)                                                                                    \
    template void part_thin_cloth(const World<D, Real>&, SweepState<D, Real>&, ThinRoom<D, Real>&,                     \
                                  const SubstepSpan<Real>&);                                                           \
    template void truncate_thin_cloth(const World<D, Real>&, SweepState<D, Real>&, ThinRoom<D, Real>&,                 \
                                      const SubstepSpan<Real>&);
SINEW_INSTANTIATE(SINEW_THIN_CONTACT)

} // namespace sinew::detail

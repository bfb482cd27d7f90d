#pragma once

#include "sinew/assert/assert.h"
#include "sinew/math/scalar.h"
#include "sinew/solver/simd/kernel.h"
#include "sinew/table/limit_columns.h"

#include <algorithm>
#include <vector>

namespace sinew {

/// Limits and compliance of batches, by number: one entry for a uniform batch, one per link otherwise. Compliance is
/// stored from the first compliant link on.
template <class Real> class BatchParameters {
  public:
    std::size_t size() const { return limits_.size(); }

    bool are(std::size_t number, Real low, Real high, Real compliance) const {
        return limits_.low(number) == low && limits_.high(number) == high && compliance_of(number) == compliance;
    }
    void add(Real low, Real high, Real compliance) {
        if (compliance != Real(0)) tell_compliance();
        limits_.append(1, low, high);
        if (has_compliance_) compliance_.push_back(compliance);
    }
    /// Appends a copy of an entry.
    void add_copy(const BatchParameters& of, std::size_t number) {
        add(of.limits_.low(number), of.limits_.high(number), of.compliance_of(number));
    }

    void resize(std::size_t size) {
        limits_.resize(size);
        if (has_compliance_) compliance_.resize(size);
    }
    void clear() { resize(0); }
    /// Reserves memory for `size` entries.
    void reserve(std::size_t size) {
        limits_.set_apart();
        tell_compliance();
        limits_.reserve(size);
        for (auto* column : {&compliance_, &quarter_per_square_}) column->reserve(size);
    }

    /// Precomputes the reciprocals read by the kernels (simd/rigid_distance.h).
    void prepare() {
        SINEW_ASSERT(!has_compliance_ || compliance_.size() == size(), "every entry has a compliance, or none has");
        quarter_per_square_.resize(size());
        for (std::size_t i = 0; i < size(); ++i) {
            const Real low = limits_.low(i);
            quarter_per_square_[i] = Real(0.25) * min(Real(1) / (low * low), max_per_square<Real>);
        }
    }

    /// Shows a kernel where the parameters are; compliance has no entries while all links are rigid.
    template <int D> void show(DistanceColumns<D, Real>& columns) const {
        columns.low = limits_.lows().data(), columns.high = limits_.highs().data();
        columns.compliance = compliance_.data(), columns.quarter_per_square = quarter_per_square_.data();
    }

  private:
    LimitColumns<Real> limits_;
    bool has_compliance_ = false;
    std::vector<Real> compliance_;
    std::vector<Real> quarter_per_square_; ///< 1 / (4 low^2)

    Real compliance_of(std::size_t number) const { return has_compliance_ ? compliance_[number] : Real(0); }

    void tell_compliance() {
        if (!has_compliance_) compliance_.assign(size(), Real(0));
        has_compliance_ = true;
    }
};

} // namespace sinew

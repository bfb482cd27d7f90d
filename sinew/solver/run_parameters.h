#pragma once

#include "sinew/solver/columns.h"
#include "sinew/solver/kernel.h"

#include <algorithm>
#include <vector>

namespace sinew {

/// What the links of runs are held at, by number: the same for a whole run, or its own for each link. While all have
/// but one limit it is held once, and compliance only from the first on that has any.
template <class Real> class RunParameters {
  public:
    std::size_t size() const { return low_.size(); }

    bool are(std::size_t number, Real low, Real high, Real compliance) const {
        return low_[number] == low && this->high()[number] == high && compliance_of(number) == compliance;
    }
    void add(Real low, Real high, Real compliance) {
        if (!are_same(low, high)) tell_limits_apart();
        if (compliance != Real(0)) tell_compliance();
        low_.push_back(low);
        if (has_high_) high_.push_back(high);
        if (has_compliance_) compliance_.push_back(compliance);
    }
    /// Once more what is there already.
    void add_copy(const RunParameters& of, std::size_t number) {
        add(of.low_[number], of.high()[number], of.compliance_of(number));
    }

    void resize(std::size_t size) {
        low_.resize(size);
        if (has_high_) high_.resize(size);
        if (has_compliance_) compliance_.resize(size);
    }
    void clear() { resize(0); }
    /// From now on adding so many allocates nothing.
    void reserve(std::size_t size) {
        tell_limits_apart();
        tell_compliance();
        for (auto* column : {&low_, &high_, &compliance_, &quarter_per_square_}) column->reserve(size);
    }

    /// What the kernels would find out (kernel_rigid.h), more slowly than they read it.
    void prepare() {
        quarter_per_square_.resize(size());
        for (std::size_t i = 0; i < size(); ++i)
            quarter_per_square_[i] = Real(0.25) * minimum(Real(1) / (low_[i] * low_[i]), most_per_square<Real>);
    }

    const Real* low() const { return low_.data(); }
    const Real* high() const { return has_high_ ? high_.data() : low_.data(); }
    const Real* compliance() const { return compliance_.data(); } ///< nowhere, while none has any
    const Real* quarter_per_square() const { return quarter_per_square_.data(); }

  private:
    bool has_high_ = false, has_compliance_ = false;
    std::vector<Real> low_, high_, compliance_;
    std::vector<Real> quarter_per_square_; ///< 1 / 4 low^2

    Real compliance_of(std::size_t number) const { return has_compliance_ ? compliance_[number] : Real(0); }

    void tell_limits_apart() {
        if (!has_high_) high_ = low_;
        has_high_ = true;
    }
    void tell_compliance() {
        if (!has_compliance_) compliance_.assign(size(), Real(0));
        has_compliance_ = true;
    }
};

} // namespace sinew

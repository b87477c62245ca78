#include "fem/closure_law.h"

namespace interflect::fem {
namespace {

/// S K S with S = diag(exp(u)), without storing it: phi' = phi.
class Scaling final : public ClosureLaw {
 public:
  Scaling(const SymmetricOperator& K, const EnvironmentColumn* environment, const EntryVariances& variances, Run& run)
      : ClosureLaw(K, environment, variances, run) {}

  double repaired(const StoredPair& pair) const override { return s_(pair.a, 0) * pair.K * s_(pair.b, 0); }
  Vector times(const Vector& v) const override {
    const Vector scaled = s_.array() * v.array();
    Vector product(scaled.rows(), 1);
    matrix().apply(scaled, product, run());
    return s_.array() * product.array();
  }

 private:
  void sum_entries(Vector& sums, Vector& stiffness) override {
    s_ = u().array().exp();
    sums = stiffness = times(Vector::Ones(size(), 1));
  }

  Vector s_;
};

}  // namespace

std::unique_ptr<ClosureLaw> scaling_law(const SymmetricOperator& K, const EnvironmentColumn* environment,
                                        const EntryVariances& variances, Run& run) {
  return std::make_unique<Scaling>(K, environment, variances, run);
}

}  // namespace interflect::fem

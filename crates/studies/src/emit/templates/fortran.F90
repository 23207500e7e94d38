‹provenance›
!
! Steps of q' = T_p(p), p' = -U_q(q), where H = T(p) + U(q).
! A step costs ‹cost›.
!
!     use shadowstep_‹identifier›, only: integrate
!     call integrate(q, p, h, steps, ‹functions›)
!
! The functions may be internal procedures, which see the variables around them.
! This file has its own test: gfortran -DSELF_TEST -O2 -ffp-contract=off ‹identifier›.F90 && ./a.out
! If the compiler may fuse products with sums (-ffp-contract), results differ by round-off.
module shadowstep_‹identifier›
  use, intrinsic :: iso_fortran_env, only: dp => real64
  implicit none
  private
‹if not processed›
  public :: step, integrate
‹end›
‹if processed›
  public :: pre, post, step, integrate
‹end›

  ‹weights›

  abstract interface
    subroutine gradient_of(q, gradient) ! gradient = U_q(q)
      import :: dp
      real(dp), intent(in) :: q(:)
      real(dp), intent(out) :: gradient(:)
    end subroutine

‹if every_kinetic›
    subroutine velocity_of(p, velocity) ! velocity = T_p(p)
‹end›
‹if not every_kinetic›
    subroutine velocity_of(p, velocity) ! velocity = p/m, as the order is for quadratic T only
‹end›
      import :: dp
      real(dp), intent(in) :: p(:)
      real(dp), intent(out) :: velocity(:)
    end subroutine
‹if gradient_kicks›

    subroutine product_of(q, v, product) ! product = U_qq(q) v
      import :: dp
      real(dp), intent(in) :: q(:), v(:)
      real(dp), intent(out) :: product(:)
    end subroutine
‹end›
  end interface

contains

‹if kept_gradient›
  ! One step of size h; g is U_q(q), before and after it.
‹end›
‹if kept_curvature›
  ! One step of size h; g is U_q(q), and w is U_qq(q) v with the velocity v of g, before and after it.
‹end›
‹if not kept›
  ! One step of size h.
‹end›
  subroutine step(q, p‹kept_arguments›, h, ‹functions›, velocity)
‹if kept_gradient›
    real(dp), intent(inout) :: q(:), p(:), g(:)
‹end›
‹if kept_curvature›
    real(dp), intent(inout) :: q(:), p(:), g(:), w(:)
‹end›
‹if not kept›
    real(dp), intent(inout) :: q(:), p(:)
‹end›
    real(dp), intent(in) :: h
    procedure(gradient_of) :: gradient
‹if gradient_kicks›
    procedure(product_of) :: hessian_product
‹end›
    procedure(velocity_of), optional :: velocity
‹if not kept›
    real(dp) :: g(size(q))
‹end›
‹if gradient_kicks›
‹if not kept_curvature›
    real(dp) :: w(size(q))
‹end›
‹end›

    ‹step›
  end subroutine

‹if processed›
  ! The pre-map: the state at which the steps begin, from that of the trajectory.
  subroutine pre(q, p, h, gradient, velocity)
    real(dp), intent(inout) :: q(:), p(:)
    real(dp), intent(in) :: h
    procedure(gradient_of) :: gradient
    procedure(velocity_of), optional :: velocity
    real(dp) :: g(size(q))

    ‹pre›
  end subroutine

  ! The post-map: the state of the trajectory, from that which steps have reached. To go on with these, give it a copy.
  subroutine post(q, p, h, gradient, velocity)
    real(dp), intent(inout) :: q(:), p(:)
    real(dp), intent(in) :: h
    procedure(gradient_of) :: gradient
    procedure(velocity_of), optional :: velocity
    real(dp) :: g(size(q))

    ‹post›
  end subroutine

‹end›
  ! This number of steps of size h.
  subroutine integrate(q, p, h, steps, ‹functions›, velocity)
    real(dp), intent(inout) :: q(:), p(:)
    real(dp), intent(in) :: h
    integer, intent(in) :: steps
    procedure(gradient_of) :: gradient
‹if gradient_kicks›
    procedure(product_of) :: hessian_product
‹end›
    procedure(velocity_of), optional :: velocity
‹if kept_gradient›
    real(dp) :: g(size(q))
‹end›
‹if kept_curvature›
    real(dp) :: g(size(q)), w(size(q))
‹end›
    integer :: n

‹if processed›
    call pre(q, p, h, gradient, velocity)
‹end›
‹if kept›
    call gradient(q, g)
‹end›
‹if kept_curvature›
    call curvature(q, g, w, hessian_product, velocity)
‹end›
    do n = 1, steps
      call step(q, p‹kept_arguments›, h, ‹functions›, velocity)
    end do
‹if processed›
    call post(q, p, h, gradient, velocity)
‹end›
  end subroutine

  subroutine drift(weight, p, q, velocity)
    real(dp), intent(in) :: weight, p(:)
    real(dp), intent(inout) :: q(:)
    procedure(velocity_of), optional :: velocity
    real(dp) :: v(size(p))

    if (present(velocity)) then
      call velocity(p, v)
      q = q + weight * v
    else ! unit masses
      q = q + weight * p
    end if
  end subroutine
‹if gradient_kicks›

  ! w = U_qq(q) v with the velocity v that g has in the place of p.
  subroutine curvature(q, g, w, hessian_product, velocity)
    real(dp), intent(in) :: q(:), g(:)
    real(dp), intent(out) :: w(:)
    procedure(product_of) :: hessian_product
    procedure(velocity_of), optional :: velocity
    real(dp) :: v(size(g))

    v = g
    if (present(velocity)) call velocity(g, v)
    call hessian_product(q, v, w)
  end subroutine
‹end›
end module

#ifdef SELF_TEST
! Kepler's problem with e = 3/5: the state that Shadowstep reaches, and the order.
program self_test
  use, intrinsic :: iso_fortran_env, only: dp => real64
  use shadowstep_‹identifier›, only: integrate
  implicit none
  real(dp) :: distance
‹if order_shows›
  real(dp) :: order
‹end›
  logical :: passed

  distance = error(‹h›, ‹count›, [‹end_q›], &
    [‹end_p›])
  if (.not. distance > 0) then
    print '(a)', '‹name›: ‹count› steps of ‹part›: the bits of Shadowstep'
  else
    print '(a, es8.1, a)', '‹name›: ‹count› steps of ‹part›:', distance, ' from Shadowstep'
  end if
  passed = distance < ‹tolerance›_dp
‹if order_shows›

  order = log(exact_error(‹coarse›) / exact_error(‹fine›)) / log(2.0_dp)
  print '(a, f0.2, a)', '‹name›: order ', order, ' observed, ‹order› proved'
  passed = passed .and. order > ‹order› - 0.5_dp
‹end›
  if (.not. passed) error stop '‹name›: the self-test has failed'

contains
‹if order_shows›

  ! The error at t = ‹time›.
  real(dp) function exact_error(steps)
    integer, intent(in) :: steps
    exact_error = error(‹time›.0_dp / steps, steps, [‹exact_q›], &
      [‹exact_p›])
  end function
‹end›

  real(dp) function error(h, steps, q_expected, p_expected)
    real(dp), intent(in) :: h, q_expected(2), p_expected(2)
    integer, intent(in) :: steps
    real(dp) :: q(2), p(2)
    q = [0.4_dp, 0.0_dp]
    p = [0.0_dp, 2.0_dp]
    call integrate(q, p, h, steps, ‹functions›)
    error = max(maxval(abs(q - q_expected)), maxval(abs(p - p_expected)))
  end function

  subroutine gradient(q, g)
    real(dp), intent(in) :: q(:)
    real(dp), intent(out) :: g(:)
    real(dp) :: r2
    r2 = q(1) * q(1) + q(2) * q(2)
    g = q / (r2 * sqrt(r2))
  end subroutine
‹if gradient_kicks›

  subroutine hessian_product(q, v, product)
    real(dp), intent(in) :: q(:), v(:)
    real(dp), intent(out) :: product(:)
    real(dp) :: r2, s
    r2 = q(1) * q(1) + q(2) * q(2)
    s = 3 * (q(1) * v(1) + q(2) * v(2)) / r2
    product = (v - s * q) / (r2 * sqrt(r2))
  end subroutine
‹end›
end program
#endif

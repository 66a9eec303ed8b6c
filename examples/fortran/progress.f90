! Watches a crunch by a callback, stops it after five reports, and continues from the valid state that was reached.
module watching
  use, intrinsic :: iso_fortran_env, only: error_unit
  use jam_packing
  implicit none
  integer, save :: reports = 0, most = 5
contains
  function watch(progress, user) bind(c) result(stop_now)
    type(jam_progress), intent(in) :: progress  ! valid during the call only
    type(c_ptr), value :: user
    integer(c_int32_t) :: stop_now
    reports = reports + 1
    print '(a, i4, a, f10.6, a, es9.1)', '  step', progress%steps, ', phi', progress%packing_fraction, &
      ', gain', progress%gain
    stop_now = merge(1, 0, reports >= most .or. c_associated(user))
  end function watch

  ! What failures do here in place of ending the program.
  subroutine complain(status, text)
    integer(c_int32_t), intent(in) :: status
    character(*), intent(in) :: text
    write (error_unit, '(a, i0, 2a)') 'failure ', status, ': ', text
  end subroutine complain
end module watching

program progress
  use watching
  implicit none
  type(packing) :: spheres
  type(jam_crunch_report) :: report
  real(c_double), allocatable :: force(:)

  call jam_on_error(complain)
  call spheres%random(n=300)
  force = spheres%forces()  ! no network yet: a failure, and an empty array
  call spheres%watch(watch)
  report = spheres%crunch()
  print '(3a, f9.6)', 'first: ', spheres%why(), ', phi ', report%packing_fraction
  if (spheres%status /= JAM_CANCELLED) error stop 'the callback did not stop the call'

  call spheres%watch()  ! no more reports
  report = spheres%crunch()
  print '(a, f9.6)', 'second: phi ', report%packing_fraction
  if (report%jammed /= 1 .or. size(force) /= 0) error stop 'not jammed'
end program progress

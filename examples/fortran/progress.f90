! Watches a crunch by a callback, stops it after five reports, and continues from the valid state that was reached.
module watching
  use jam
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
end module watching

program progress
  use jam
  use watching
  implicit none
  type(c_ptr) :: sys
  type(jam_create_options) :: create
  type(jam_crunch_report) :: report
  integer(c_int32_t) :: status

  call jam_defaults(create)
  create%n = 300
  status = jam_create(create, out=sys)
  if (status < 0) error stop 'create failed'
  status = jam_set_progress(sys, c_funloc(watch), c_null_ptr)
  status = jam_crunch(sys, report=report)
  print '(3a, f9.6)', 'first: ', jam_text(jam_status_string(status)), ', phi ', report%packing_fraction
  if (status /= JAM_CANCELLED) error stop 'the callback did not stop the call'

  status = jam_set_progress(sys, c_null_funptr, c_null_ptr)  ! no more reports
  status = jam_crunch(sys, report=report)
  print '(3a, f9.6)', 'second: ', jam_text(jam_status_string(status)), ', phi ', report%packing_fraction
  if (report%jammed /= 1) error stop 'not jammed'
  call jam_destroy(sys)
end program progress

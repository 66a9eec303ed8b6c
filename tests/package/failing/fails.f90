! A call that fails: the handler gets the text.
module heard
  use, intrinsic :: iso_fortran_env, only: error_unit
  use jam_packing
  implicit none
  integer :: failures = 0
contains
  subroutine hear(status, text)
    integer(c_int32_t), intent(in) :: status
    character(*), intent(in) :: text
    if (status == JAM_E_DIMENSION) failures = failures + 1
    write (error_unit, '(a)') text
  end subroutine
end module

program fails
  use heard
  implicit none
  type(packing) :: spheres
  call jam_on_error(hear)
  call spheres%random(n=64, dim=9)
  if (failures /= 1) error stop 1
end program

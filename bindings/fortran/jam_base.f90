! What a packing of the module jam_packing is made of: the handle of C, how one is made and freed, its state, and the
! one place where failures go. Procedures have text errors, shapes that are checked, results that allocate themselves,
! indices from 1.
module jam_base
  use jam
  implicit none

  ! Gets every failure: a status below 0 and the library's text. When it returns, results are empty and the system is as
  ! before.
  abstract interface
    subroutine jam_error_handler(status, text)
      import :: c_int32_t
      integer(c_int32_t), intent(in) :: status
      character(*), intent(in) :: text
    end subroutine jam_error_handler
  end interface
  procedure(jam_error_handler), pointer, save, private :: handler => null()

  ! N spheres in a periodic cell. Assignment copies, and frees what was there; a local one is freed at the end of its
  ! procedure.
  type :: jam_handle
    type(c_ptr) :: sys = c_null_ptr        ! for the functions of module jam
    integer(c_int32_t) :: status = JAM_OK  ! of the last call; above 0: stopped early, or no certain answer
  contains
    procedure :: random
    procedure :: from_arrays
    procedure :: read_file
    procedure :: read_checkpoint
    procedure :: tile
    procedure :: free
    procedure :: positions
    procedure :: velocities
    procedure :: diameters
    procedure :: write_file
    procedure :: notes
    procedure :: watch
    procedure :: cancel
    procedure :: why
    procedure :: done
    procedure :: extents
    procedure, private :: copy_of
    procedure, private :: take
    generic :: assignment(=) => copy_of
    final :: free_at_end
  end type jam_handle

  ! Reached through the type; a program may use these names for its own procedures.
  private :: random, from_arrays, read_file, read_checkpoint, tile, free, free_at_end, copy_of, positions, velocities, &
             diameters, take, copy_view, write_file, notes, watch, cancel, why, done, extents, from_one

contains

  ! From now on failures call `new`. Without it they print their text on standard error and end the program with status
  ! 1.
  subroutine jam_on_error(new)
    procedure(jam_error_handler), optional :: new
    handler => null()
    if (present(new)) handler => new
  end subroutine jam_on_error

  ! The library's text with spheres and contacts that count from 1, as the arrays here do.
  function from_one(text) result(told)
    character(*), intent(in) :: text
    character(:), allocatable :: told
    character(10), parameter :: words(3) = [character(10) :: 'sphere ', 'spheres ', 'contact ']
    integer :: k, w, length
    told = ''
    k = 1
    scan: do while (k <= len(text))
      do w = 1, size(words)
        length = len_trim(words(w)) + 1
        if (k > 1) then
          if (verify(text(k - 1:k - 1), ' (') /= 0) cycle
        end if
        if (index(text(k:), words(w)(:length)) /= 1) cycle
        told = told//words(w)(:length)
        k = k + length
        call one_more()
        if (w == 2 .and. index(text(k:), ' and ') == 1) then
          told = told//' and '
          k = k + 5
          call one_more()
        end if
        cycle scan
      end do
      told = told//text(k:k)
      k = k + 1
    end do scan
  contains
    subroutine one_more()
      character(24) :: number
      integer(c_int64_t) :: value
      integer :: digits
      digits = verify(text(k:)//' ', '0123456789') - 1
      if (digits < 1 .or. digits > 18) return
      read (text(k:k + digits - 1), *) value
      write (number, '(i0)') value + 1
      told = told//trim(number)
      k = k + digits
    end subroutine one_more
  end function from_one

  ! The one way of all statuses: keeps it, and hands a failure to the handler.
  subroutine done(self, status)
    use, intrinsic :: iso_fortran_env, only: error_unit
    class(jam_handle), intent(inout) :: self
    integer(c_int32_t), intent(in) :: status
    self%status = status
    if (status >= 0) return
    select case (jam_message())
    case ('sys is NULL', 'src is NULL', 'other is NULL')
      call jam_set_error('a packing is empty: make or read one first')
    end select
    if (associated(handler)) then
      call handler(status, from_one(jam_message()))
    else
      write (error_unit, '(2a)') 'libjam failed: ', from_one(jam_message())
      error stop 1
    end if
  end subroutine done

  ! Why the last call on this thread has a status other than JAM_OK, a sentence; '' where it has that status.
  function why(self) result(text)
    class(jam_handle), intent(in) :: self
    character(:), allocatable :: text
    text = ''
    if (self%status /= JAM_OK) text = from_one(jam_message())
  end function why

  ! Random sequential start. Only ratios of diameters count. `options` has everything else; n, dim, seed and
  ! packing_fraction given beside it win. cell(d, d) has a vector in each column.
  subroutine random(self, n, dim, seed, packing_fraction, diameters, cell, options)
    class(jam_handle), intent(inout) :: self
    integer, intent(in), optional :: n, dim, seed
    real(c_double), intent(in), optional :: packing_fraction
    real(c_double), intent(in), contiguous, target, optional :: diameters(:), cell(:, :)
    type(jam_create_options), intent(in), optional :: options
    type(jam_create_options) :: o
    type(c_ptr) :: made
    call jam_defaults(o)
    if (present(options)) o = options
    if (present(n)) o%n = n
    if (present(dim)) o%dim = dim
    if (present(seed)) o%seed = seed
    if (present(packing_fraction)) o%packing_fraction = packing_fraction
    if (present(diameters) .and. .not. present(n)) o%n = size(diameters)
    call self%take(jam_create(o, diameters=diameters, cell=cell, out=made), made)
  end subroutine random

  ! Spheres at x(d, n), in the unit of box, which they are wrapped into; diameters: one of each, or an array of one for
  ! all.
  subroutine from_arrays(self, x, diameters, box, cell, options)
    class(jam_handle), intent(inout) :: self
    real(c_double), intent(in), contiguous, target :: x(:, :), diameters(:)
    real(c_double), intent(in), optional :: box
    real(c_double), intent(in), contiguous, target, optional :: cell(:, :)
    type(jam_create_options), intent(in), optional :: options
    type(jam_create_options) :: o
    type(c_ptr) :: made
    character(120) :: text
    if (size(x, 1) > JAM_MAX_DIM) then
      write (text, '(2(a, i0), a)') 'x(', size(x, 1), ', ', size(x, 2), ') must be x(d, n): pass its transpose'
      call jam_set_error(trim(text))
      call self%done(JAM_E_ARGUMENT)
      return
    end if
    call jam_defaults(o)
    if (present(options)) o = options
    o%dim = size(x, 1)
    if (present(box)) o%box = box
    o%n = size(x, 2)
    call self%take(jam_create(o, x, diameters, cell, made), made)
  end subroutine from_arrays

  ! A file of any format that jam_read knows; notes() has what was changed or assumed. layout: what the file does not
  ! say, as jam_read_as takes it.
  subroutine read_file(self, path, options, layout)
    class(jam_handle), intent(inout) :: self
    character(*), intent(in) :: path
    type(jam_create_options), intent(in), optional :: options
    character(*), intent(in), optional :: layout
    type(c_ptr) :: made
    if (present(layout)) then
      call self%take(jam_read_as(path, layout, options, out=made), made)
    else
      call self%take(jam_read(path, options, out=made), made)
    end if
  end subroutine read_file

  ! A file of write_checkpoint.
  subroutine read_checkpoint(self, path)
    class(jam_handle), intent(inout) :: self
    character(*), intent(in) :: path
    type(c_ptr) :: made
    call self%take(jam_read_checkpoint(path, out=made), made)
  end subroutine read_checkpoint

  ! The copies of another packing side by side: count(c) of them along cell vector c.
  subroutine tile(self, from, count)
    class(jam_handle), intent(inout) :: self
    class(jam_handle), intent(in) :: from
    integer, intent(in) :: count(:)
    type(c_ptr) :: made
    call self%take(jam_tile(from%sys, int(count, c_int32_t), out=made), made)
  end subroutine tile

  subroutine copy_of(to, from)
    class(jam_handle), intent(inout) :: to
    class(jam_handle), intent(in) :: from
    type(c_ptr) :: made
    if (.not. c_associated(from%sys)) then
      call to%free()
      return
    end if
    if (c_associated(to%sys, from%sys)) return
    call to%take(jam_copy(from%sys, made), made)
  end subroutine copy_of

  ! What a call has made takes the place of the packing. A call that fails or is stopped leaves that.
  subroutine take(self, status, made)
    class(jam_handle), intent(inout) :: self
    integer(c_int32_t), intent(in) :: status
    type(c_ptr), intent(in) :: made
    call self%done(status)
    if (status < 0) return
    if (.not. c_associated(made)) return
    call self%free()
    self%sys = made
  end subroutine take

  subroutine free(self)
    class(jam_handle), intent(inout) :: self
    call jam_destroy(self%sys)
    self%sys = c_null_ptr
  end subroutine free

  subroutine free_at_end(self)
    type(jam_handle), intent(inout) :: self
    call self%free()
  end subroutine free_at_end

  ! Dimension, spheres, stable spheres N' and contacts; those without a network are 0.
  subroutine extents(self, d, n, stable, contacts)
    class(jam_handle), intent(in) :: self
    integer(c_size_t), intent(out) :: d, n
    integer(c_size_t), intent(out), optional :: stable, contacts
    type(jam_info) :: now
    d = 0
    n = 0
    if (c_associated(self%sys)) then
      if (jam_get_info(self%sys, now) == JAM_OK) then
        d = now%dim
        n = now%n
      end if
    end if
    if (present(stable)) then
      if (jam_hessian_map(self%sys, needed=stable) /= JAM_OK) stable = 0
    end if
    if (present(contacts)) then
      if (jam_forces(self%sys, needed=contacts) /= JAM_OK) contacts = 0
    end if
  end subroutine extents

  ! A copy of what a view shows; nothing after a failure.
  function copy_view(self, which) result(x)
    class(jam_handle), intent(inout) :: self
    integer(c_int32_t), intent(in) :: which
    real(c_double), allocatable :: x(:)
    real(c_double), pointer :: shown(:)
    type(c_ptr) :: view
    integer(c_size_t) :: length
    integer(c_int32_t) :: status
    status = jam_view(self%sys, which, view, length)
    allocate (x(merge(length, 0_c_size_t, status >= 0)))
    if (size(x) > 0) then
      call c_f_pointer(view, shown, [length])
      x(:) = shown
    end if
    call self%done(status)
  end function copy_view

  ! Copy of the positions x(d, n) in [0, box).
  function positions(self) result(x)
    class(jam_handle), intent(inout) :: self
    real(c_double), allocatable :: x(:, :)
    integer(c_size_t) :: d, n
    call self%extents(d, n)
    x = reshape(copy_view(self, JAM_VIEW_POSITIONS), [d, n])
  end function positions

  ! Copy of the velocities v(d, n), kT/m = 1.
  function velocities(self) result(v)
    class(jam_handle), intent(inout) :: self
    real(c_double), allocatable :: v(:, :)
    integer(c_size_t) :: d, n
    call self%extents(d, n)
    v = reshape(copy_view(self, JAM_VIEW_VELOCITIES), [d, n])
  end function velocities

  ! Copy of the n diameters.
  function diameters(self) result(sigma)
    class(jam_handle), intent(inout) :: self
    real(c_double), allocatable :: sigma(:)
    sigma = copy_view(self, JAM_VIEW_DIAMETERS)
  end function diameters

  ! Writes the packing with 17 digits; without format the ending of the name gives it.
  subroutine write_file(self, path, format)
    class(jam_handle), intent(inout) :: self
    character(*), intent(in) :: path
    integer(c_int32_t), intent(in), optional :: format
    integer(c_int32_t) :: kind
    kind = JAM_FORMAT_AUTO
    if (present(format)) kind = format
    call self%done(jam_write(self%sys, path, kind))
  end subroutine write_file

  ! What was changed or assumed when the system was made, a sentence a line.
  function notes(self) result(text)
    class(jam_handle), intent(in) :: self
    character(:), allocatable :: text
    text = jam_text(jam_notes(self%sys))
  end function notes

  ! Calls `on_progress`, a jam_progress_fn, during long calls; without it nothing is called any more.
  subroutine watch(self, on_progress)
    class(jam_handle), intent(inout) :: self
    procedure(jam_progress_fn), optional :: on_progress
    type(c_funptr) :: at
    at = c_null_funptr
    if (present(on_progress)) at = c_funloc(on_progress)
    call self%done(jam_set_progress(self%sys, at, c_null_ptr))
  end subroutine watch

  ! Stops the call that runs, or the next one.
  subroutine cancel(self)
    class(jam_handle), intent(inout) :: self
    call self%done(jam_cancel(self%sys))
  end subroutine cancel

  ! Diameters of a law given by text, as in 'lognormal:deviation=0.3' or 'sieve:grading.csv'. Fields of `options` beside
  ! the law's own, such as n, are taken from there.
  function jam_sizes(law, n, options) result(sigma)
    character(*), intent(in) :: law
    integer, intent(in), optional :: n
    type(jam_diameters_options), intent(in), optional :: options
    real(c_double), allocatable :: sigma(:), curve(:)
    type(jam_diameters_options) :: o
    type(jam_handle) :: none
    integer(c_size_t) :: length
    allocate (sigma(0))
    call jam_defaults(o)
    if (present(options)) o = options
    if (present(n)) o%n = n
    call none%done(jam_parse_diameters(law, o, needed=length))
    if (none%status < 0) return
    allocate (curve(length))
    if (length > 0) call none%done(jam_parse_diameters(law, o, curve))
    if (length > 0) call none%done(jam_diameters(o, curve, needed=length))
    if (size(curve) == 0) call none%done(jam_diameters(o, needed=length))
    if (none%status < 0) return
    deallocate (sigma)
    allocate (sigma(length))
    if (size(curve) > 0) call none%done(jam_diameters(o, curve, sigma))
    if (size(curve) == 0) call none%done(jam_diameters(o, out=sigma))
  end function jam_sizes
end module jam_base

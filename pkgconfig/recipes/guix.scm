;; guix build -f guix.scm
(use-modules (guix gexp)
             (guix packages)
             (guix download)
             (guix build-system cmake)
             ((guix licenses) #:prefix license:)
             (gnu packages algebra)
             (gnu packages compression)
             (gnu packages maths)
             (gnu packages pkg-config)
             (gnu packages python))

(package
  (name "libjam")
  (version "1.0.0")
  (source
   (origin
     (method url-fetch)
     (uri (string-append "https://github.com/libjam/libjam/archive/refs/tags/v" version ".tar.gz"))
     (sha256 (base32 "0000000000000000000000000000000000000000000000000000"))))
  (build-system cmake-build-system)
  (arguments
   (list #:tests? #f  ; they need cmocka and an hour
         #:configure-flags
         #~(list "-DJAM_BLAS=openblas" "-DJAM_CLP=ON" "-DJAM_USE_VORO=OFF" "-DJAM_BUILD_EXAMPLES=OFF")))
  (native-inputs (list pkg-config python))
  (inputs (list clp eigen openblas spectra zlib))
  (home-page "https://github.com/libjam/libjam")
  (synopsis "Jammed packings of hard spheres")
  (description "libjam makes and analyses jammed packings of hard spheres by event-driven molecular dynamics, linear
programming and a barrier path, in two to eight dimensions.")
  (license (list license:expat license:mpl2.0)))

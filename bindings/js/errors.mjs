/** A call of libjam failed, and the packing is as before it; or it was stopped, status 'cancelled' or 'limit'. */
export class JamError extends Error {
  name = 'JamError';

  /**
   * @param {string} status word of the status, such as 'overlap'
   * @param {string} message the library's sentence
   */
  constructor(status, message, options) {
    super(message, options);
    this.status = status;
  }
}

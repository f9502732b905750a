// SPDX-License-Identifier: GPL-3.0-or-later
// Questions to the program, which runs in the page itself: WebAssembly in workers, so that the page never waits for it.
import { byId } from "./dom";
import type { Argument, Path, Request } from "./requests";
import type { Inertia, Rotation, Vector } from "./rotation";
import { answerRequests } from "./worker";

/** What the program says is wrong, and the name of the quantity that it blames, if it blames one. */
export class ApiError extends Error {
  readonly blames: string | undefined;

  constructor(message: string) {
    // Arguments as the page calls them: "tangential_velocity" for "--tangential-velocity".
    super(message.replace(/--([a-z][a-z-]*)/g, (_flag, name: string) => name.replace(/-/g, "_")));
    this.name = "ApiError";
    this.blames = /^([a-z][a-z_]*) [^ ]+: /.exec(this.message)?.[1];
  }
}

/** As the program takes them: texts. */
function textOf(argument: Argument): string {
  if (!Array.isArray(argument)) return String(argument);
  return Array.isArray(argument[0]) ? JSON.stringify(argument) : argument.join("x");
}

interface Job {
  request: Request;
  resolve: (answer: unknown) => void;
  reject: (error: unknown) => void;
  signal: AbortSignal | undefined;
}

/** A text beyond this is no scene; the module's stack would have to hold it. */
const LONGEST = 200_000;
/** A computation that nobody waits for any more may end by itself for so long; then its worker is ended [ms]. */
const PATIENCE = 400;

/** One worker, which answers one request after the other. */
class Lane {
  private worker: Worker | null = null;
  private readonly waiting: Job[] = [];
  private running: Job | null = null;

  ask(job: Job): void {
    this.waiting.push(job);
    job.signal?.addEventListener("abort", () => this.leave(job));
    this.next();
  }

  private leave(job: Job): void {
    job.reject(new DOMException("left", "AbortError"));
    const place = this.waiting.indexOf(job);
    if (place >= 0) this.waiting.splice(place, 1);
    if (this.running === job) setTimeout(() => { if (this.running === job) this.restart(); }, PATIENCE);
  }

  private next(): void {
    if (this.running) return;
    this.running = this.waiting.shift() ?? null;
    if (!this.running) return;
    const { path, body } = this.running.request;
    const texts = Object.fromEntries(Object.entries(body).map(([name, argument]) => [name, textOf(argument)]));
    this.worker ??= this.start();
    this.worker.postMessage([path, JSON.stringify(texts)]);
  }

  private start(): Worker {
    const worker = new Worker(workerAddress());
    void compiled.models.then((code) => worker.postMessage(code));
    worker.onmessage = ({ data }: MessageEvent<{ error?: string }>) => this.answer(data);
    worker.onerror = (event) => {
      event.preventDefault();
      this.running?.reject(new ApiError("the computation broke off: it needs more memory than the browser gives"));
      this.restart();
    };
    return worker;
  }

  private answer(answer: { error?: string }): void {
    if (answer.error === undefined) this.running?.resolve(answer);
    else this.running?.reject(new ApiError(answer.error));
    this.running = null;
    this.next();
  }

  private restart(): void {
    this.worker?.terminate();
    this.worker = null;
    this.running = null;
    this.next();
  }
}

/** Of index.html. */
declare const compiled: { models: Promise<WebAssembly.Module> };

let address = "";
/** Of the worker's program, a text within the page. */
function workerAddress(): string {
  const texts = [byId("module").textContent ?? "", `(${answerRequests.toString()})();`];
  return (address ||= URL.createObjectURL(new Blob(texts, { type: "text/javascript" })));
}

/** The slower model has its own worker: the other one does not wait for it. */
const lanes = { quick: new Lane(), slow: new Lane() };
const SLOW: readonly Path[] = ["simulate", "compare"];

export function ask<Answer>(request: Request, signal?: AbortSignal): Promise<Answer> {
  return new Promise((resolve, reject) => {
    if (String(request.body["text"] ?? "").length > LONGEST) throw new ApiError(`a scene file has at most ${LONGEST} characters`);
    const lane = SLOW.includes(request.path) ? lanes.slow : lanes.quick;
    lane.ask({ request, resolve: resolve as (answer: unknown) => void, reject, signal });
  });
}

/**
 * One kind of question, of which only the newest counts. A slider asks faster than answers come: while one question is
 * under way the next waits, and is replaced by one that is newer still, so that answers keep coming while it moves.
 */
export class Latest<Answer, Context> {
  private running: AbortController | null = null;
  private waiting: { request: Request; context: Context } | null = null;
  private timer = 0;

  constructor(
    private readonly delay: number,
    private readonly onAnswer: (answer: Answer, context: Context) => void,
    private readonly onError: (error: ApiError, context: Context) => void,
    private readonly onBusy: (busy: boolean) => void = () => undefined,
  ) {}

  /** The context comes back with the answer: by then the page may have moved on. */
  ask(request: Request, context: Context): void {
    this.waiting = { request, context };
    this.onBusy(true);
    if (this.delay > 0) {
      // A slow model is not worth finishing for a situation that is gone.
      this.running?.abort();
      clearTimeout(this.timer);
      this.timer = window.setTimeout(() => void this.next(), this.delay);
    } else if (!this.running) void this.next();
  }

  /** Nobody wants the answer any more. */
  leave(): void {
    this.waiting = null;
    clearTimeout(this.timer);
    this.running?.abort();
    this.running = null;
    this.onBusy(false);
  }

  private async next(): Promise<void> {
    if (!this.waiting) return;
    const { request, context } = this.waiting;
    this.waiting = null;
    const running = new AbortController();
    this.running = running;
    try {
      const answer = await ask<Answer>(request, running.signal);
      if (!running.signal.aborted) this.onAnswer(answer, context);
    } catch (error) {
      if (!running.signal.aborted) {
        if (!(error instanceof ApiError)) throw error;
        if (!this.waiting) this.onError(error, context);
      }
    } finally {
      const isLeft = this.running !== running;
      if (!isLeft) this.running = null;
      if (this.waiting && this.delay === 0) void this.next();
      else if (!this.waiting && !isLeft) this.onBusy(false);
    }
  }
}

export interface Impact {
  n: number;
  start: number;
  duration: number;
  end: string;
  /** In space: names of the corners that strike, and the Euler parameters at the touch. */
  corners?: string;
  attitude?: Rotation;
  /** How many places touch one after the other, or corners at once. */
  touches?: number;
  inclination_deg: number;
  /** As one sees it, and as the program counts it. */
  contact_angle_deg: number;
  program_angle_deg?: number;
  approach_speed: number;
  restitution: number | null;
  impulse_normal: number;
  impulse_tangential: number;
  impulse: Vector;
  peak_force: number | null;
  velocity_after: Vector;
  angular_velocity_after: Vector;
  energy_before: number;
  energy_after: number;
  energy_loss: number;
  /** Whether it slipped or stuck, in turn. */
  mode?: string;
  /** False if errors have grown so far that nothing can be said about this impact; by so many times. */
  predictable?: boolean;
  amplification?: number | null;
  error_estimate?: Bars;
}

/** Error bars, by the names of the numbers. */
export type Bars = Partial<Record<"start" | "contact_angle_deg" | "impulse_normal" | "impulse_tangential" | "duration" | "peak_force" | "energy_loss", number | null>
  & Record<"velocity_after" | "angular_velocity_after", Vector>>;

/** Columns of the time history that the page reads. */
export type History = Record<
  "t" | "x" | "y" | "z" | "beta0" | "beta1" | "beta2" | "beta3" | "vx" | "vy" | "vz" | "wx" | "wy" | "wz" | "fx" | "fy" | "fz"
  | "energy_rotation" | "energy_ground" | "energy_total" | "in_contact", number[]>;

export interface SequenceAnswer {
  body: { mass: number; centre: Vector; inertia: Inertia };
  impacts: Impact[];
  outcome: string;
  /** What the program says beside its numbers, a clause each. */
  warnings?: string[];
}

export interface SimulateAnswer extends SequenceAnswer {
  history: History;
}

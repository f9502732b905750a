// SPDX-License-Identifier: GPL-3.0-or-later
// Questions to the program that serves the page, or their answers from an offline copy.
import { keyOf, type Json, type Request } from "./requests";
import type { Parameters } from "./parameters";

export interface PrecomputedScene {
  name: string;
  title: string;
  parameters: Parameters;
  angles: number[];
  answers: Record<string, Json>;
}

interface Precomputed {
  clatter?: string;
  scenes?: PrecomputedScene[];
}

/** What the program says is wrong, and the name of the quantity that it blames, if it blames one. */
export class ApiError extends Error {
  readonly blames: string | undefined;

  constructor(message: string) {
    super(message);
    this.name = "ApiError";
    this.blames = /^([a-z][a-z_]*) [^ ]+: /.exec(this.message)?.[1];
  }
}

const precomputed = JSON.parse(document.getElementById("precomputed")?.textContent ?? "{}") as Precomputed;
export const offlineScenes: readonly PrecomputedScene[] = precomputed.scenes ?? [];
export const isOffline = offlineScenes.length > 0;
const answers = new Map(offlineScenes.flatMap((scene) => Object.entries(scene.answers)));

/** Whether an answer can be had; without a server only what was precomputed. */
export function isAvailable(request: Request): boolean {
  return !isOffline || answers.has(keyOf(request));
}

export async function ask<Answer>(request: Request, signal?: AbortSignal): Promise<Answer> {
  if (isOffline) {
    const answer = answers.get(keyOf(request));
    if (answer === undefined) throw new ApiError("this offline copy does not hold that answer");
    return answer as Answer;
  }
  let response: Response;
  try {
    response = await fetch(`/api/${request.path}`, {
      method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(request.body), signal: signal ?? null,
    });
  } catch (error) {
    if (signal?.aborted) throw error;
    throw new ApiError("the program does not answer; is clatter demo still running?");
  }
  const answer = (await response.json().catch(() => ({ error: `the program answered with status ${response.status}` }))) as
    Answer & { error?: string };
  if (!response.ok) throw new ApiError(answer.error ?? `the program answered with status ${response.status}`);
  return answer;
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
      this.timer = window.setTimeout(() => void this.next(), isOffline ? 0 : this.delay);
    } else if (!this.running) void this.next();
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
      if (this.running === running) this.running = null;
      if (this.waiting && this.delay === 0) void this.next();
      else if (!this.waiting && !this.running) this.onBusy(false);
    }
  }
}

// uart_transmitter, uart_receiver and rate_detector: every byte at rates between 4 and 90 clocks a bit, with the two ends'
// clocks 2 % apart; a measured rate is the true one, and is kept while measuring is not enabled.
`timescale 1ns / 1ps
module line_bench;
    reg clk = 0, rst = 1;
    always #5 clk = !clk;

    reg  [17:0] send_period = 533, receive_period = 533;
    reg  [7:0]  send_data = 0;
    reg         send_valid = 0;
    wire        send_ready, line;
    wire [7:0]  received;
    wire        received_valid;
    uart_transmitter transmitter (
        .clk(clk), .rst(rst), .period(send_period), .data(send_data), .valid(send_valid), .ready(send_ready), .line(line));
    uart_receiver receiver (
        .clk(clk), .rst(rst), .period(receive_period), .line(line), .data(received), .valid(received_valid));

    reg         measure = 0;
    wire [17:0] measured;
    rate_detector #(.INITIAL_PERIOD(18'd4000)) detector (
        .clk(clk), .rst(rst), .enable(measure), .line(line), .period(measured));

    integer errors = 0, count = 0, i, k;
    reg [7:0] wanted;
    always @(posedge clk)
        if (received_valid) begin
            count = count + 1;
            if (received !== wanted) begin
                errors = errors + 1;
                $display("FAIL: period %0d sent %h received %h", send_period, wanted, received);
            end
        end

    task send(input [7:0] value);
        begin
            @(negedge clk);
            send_data = value;
            send_valid = 1;
            while (!send_ready) @(negedge clk);
            @(negedge clk) send_valid = 0;
        end
    endtask
    task wait_idle;
        begin
            while (!send_ready) @(negedge clk);
            repeat (send_period / 4) @(negedge clk);
        end
    endtask
    task all_bytes(input [17:0] to, input [17:0] from);
        begin
            send_period = to;
            receive_period = from;
            count = 0;
            for (i = 0; i < 256; i = i + 1) begin
                wanted = i;
                send(i);
                wait_idle;
            end
            if (count != 256) begin
                errors = errors + 1;
                $display("FAIL: %0d of 256 bytes at period %0d, receiver %0d", count, to, from);
            end
        end
    endtask
    task rate(input [17:0] true_period, input [7:0] pattern, input enable, input [17:0] low, input [17:0] high);
        begin
            send_period = true_period;
            measure = enable;
            receive_period = true_period;
            wanted = pattern;
            for (k = 0; k < 8; k = k + 1) send(pattern);
            wait_idle;
            measure = 0;
            if (measured < low || measured > high) begin
                errors = errors + 1;
                $display("FAIL: bytes %h at period %0d measured %0d, not %0d to %0d", pattern, true_period, measured, low, high);
            end
        end
    endtask

    initial begin
        repeat (4) @(negedge clk);
        rst = 0;
        repeat (40) @(negedge clk);
        all_bytes(64, 64);
        all_bytes(101, 101);
        all_bytes(533, 533);
        all_bytes(533, 544);
        all_bytes(533, 522);
        all_bytes(1440, 1440);
        rate(64, 8'h55, 0, 4000, 4000);
        rate(64, 8'h55, 1, 64, 68);  // there is a clock between the bytes
        rate(533, 8'h55, 1, 531, 535);
        rate(13889, 8'h55, 1, 13880, 13900);
        rate(533, 8'hf0, 0, 13880, 13900);
        rate(533, 8'h00, 1, 13880, 13900);
        rate(533, 8'h33, 1, 13880, 13900);
        if (errors == 0) $display("passed");
        $finish;
    end
endmodule
